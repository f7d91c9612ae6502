// SPDX-License-Identifier: MIT
/// \file
/// `risorius solve`: finds the muscle activations for measured or sculpted shapes, or for landmarks over time, and writes them as a script.
///
///   minimise over a_t   sum_t ( 1/2 |u(a_t) - g_t|_w^2 / G + l1 |a_t|_1 + l2/2 |a_t|^2 ) + temporal/2 sum_t |a_t - a_t-1|^2
///
///   a_t   activations of muscles, jaw, gaze, tongue, pressure in the mouth, each within its range
///   u     displacement of the face in equilibrium      g   what is given, m
///   w     skin area of a vertex, and a fifth of its mean for vertices of other parts that the shapes move; 1 for landmarks
///   G     |g|_w^2; of a sequence the largest of all frames
///
/// Shapes are solved independently, each from rest. Frames of a sequence start from the frame before, and are then solved once more
/// backwards in time, between both neighbours.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/inverse/fit_activations.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

struct SolveOptions {
    std::filesystem::path rig = {}, out = {};  ///< out: a folder
    /// Exactly one of these three. A table of "Measured shapes" (.json), or shapes.glb of `risorius shapes`.
    std::filesystem::path shapes = {};
    std::vector<std::filesystem::path> meshes = {};  ///< the rig's mesh with displaced vertices
    std::filesystem::path landmarks = {};  ///< a table: time_s, ID.x_mm, ID.y_mm, ID.z_mm, ...
    std::vector<std::string> only = {};    ///< of `shapes`; empty: all
    std::string quality = "preview";
    double l1_weight = 2e-4, l2_weight = 2e-4, temporal_weight = 2e-2;
    int fps = 30;     ///< at most so many frames of a sequence per second are solved
    int threads = 0;  ///< shapes solved at a time; results do not depend on it
};

/// A shape, or a frame.
struct SolvedDrive {
    std::string name;
    double time_s = 0;  ///< of a frame
    track::Drive drive;
    double rms_m = 0, max_m = 0;  ///< of u - g over the points that count
    double given_rms_m = 0;       ///< of g
    double highest = 0;           ///< largest activation of a muscle
};

struct SolveReport {
    std::string name, rig, given;
    bool sequence = false;
    int points = 0;  ///< number of vertices or landmarks that count
    track::ChannelTable channels;
    std::vector<SolvedDrive> solved;

    double rms_m() const;  ///< RMS over all shapes or frames, with equal weights
    Json json() const;
};

/// Writes OUT/script.json, which `render` plays, and OUT/results.json; both or none. Throws Error, Interrupted.
SolveReport solve_activations(const SolveOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
