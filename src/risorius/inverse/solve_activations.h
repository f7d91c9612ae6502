// SPDX-License-Identifier: MIT
/// \file
/// The program `risorius solve`. It finds the muscle activations that reproduce measured or sculpted shapes, or landmarks over
/// time, and writes them as a script.
///
///   minimise over a_t   sum_t ( 1/2 |u(a_t) - g_t|_w^2 / G + l1 |a_t|_1 + l2/2 |a_t|^2 ) + temporal/2 sum_t |a_t - a_t-1|^2
///
///   a_t   activations of muscles, jaw, gaze, tongue, pressure in the mouth, each within its range
///   u     displacement of the face in equilibrium      g   the target, m
///   w     skin area of a vertex, and a fifth of its mean for vertices of other parts that the shapes move; 1 for landmarks
///   G     |g|_w^2; for a sequence its maximum over the frames
///
/// Shapes are solved independently, each from rest. A frame of a sequence starts from the solution of the frame before.
/// Afterwards all frames are solved once more, backwards in time, with the temporal term for both neighbours.
///
/// A sequence may be solved as action units instead, see detail/unit_solver.h: few curves with few keys.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/inverse/detail/unit_solver.h"
#include "risorius/inverse/fit_activations.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

/// Options of solve_activations().
struct SolveOptions {
    std::filesystem::path rig = {}, out = {};  ///< out: a folder
    /// Exactly one of the following three is given. A table of measured shapes (.json), or glTF with shapes on the rig's mesh.
    std::filesystem::path shapes = {};
    /// Copies of the rig's mesh with displaced vertices
    std::vector<std::filesystem::path> meshes = {};
    /// Landmarks over time, see detail/landmark_recording.h
    std::filesystem::path landmarks = {};
    /// Begin and end of a time in which the face is neutral, s; none: the first row
    std::optional<std::array<double, 2>> neutral_s = {};
    std::array<int, 2> picture_px = {};  ///< size of the picture of MediaPipe's JSON; 0: not known
    std::vector<std::string> only = {};  ///< names in `shapes`; empty: all
    std::string quality = "preview";
    double l1_weight = 2e-4, l2_weight = 2e-4, temporal_weight = 2e-2;
    /// "units" (sequences only) or "muscles"; empty: units for sequences, else muscles
    std::string as = {};
    std::vector<std::string> with =
        {};        ///< "pressure" (in the mouth), "tongue": used by units only if they are named
    int fps = 30;  ///< maximum number of frames of a sequence that are solved per second
    /// Number of shapes that are solved at the same time; results do not depend on it
    int threads = 0;
};

/// The solution of a shape or frame.
struct SolvedDrive {
    std::string name;
    double time_s = 0;  ///< time of a frame
    track::Drive drive;
    double rms_m = 0, max_m = 0;  ///< error |u - g| over the vertices or landmarks with weight
    double given_rms_m = 0;       ///< RMS of g
    double highest = 0;           ///< largest activation of a muscle
    /// Whether its error was simulated; else it is estimated between frames whose error was
    bool simulated = true;
};

/// The result of solve_activations().
struct SolveReport {
    std::string name, rig, given;
    bool sequence = false;
    int points = 0;  ///< number of vertices or landmarks with weight
    track::ChannelTable channels;
    std::vector<SolvedDrive> solved;
    std::vector<UnitCurve> curves;   ///< of a sequence that was solved as units
    std::vector<std::string> notes;  ///< values of landmarks that were missing and are bridged
    std::string set;  ///< of landmarks: "rig", or the set of points that they are from
    std::optional<double>
        sitter_scale;  ///< m of the rig per unit of the sitter, of points of a set

    double rms_m() const;  ///< RMS over all shapes or frames, equally weighted
    Json json() const;
};

/// Solves and writes OUT/script.json, which `render` plays, and OUT/results.json: both or none. Throws Error, Interrupted.
SolveReport solve_activations(const SolveOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
