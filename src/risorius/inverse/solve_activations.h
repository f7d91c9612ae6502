// `risorius solve`: from shapes that somebody has measured or sculpted, or from landmarks over time, to the muscles that make them,
// as a script.
//
//   minimise over a_t   sum_t ( 1/2 |u(a_t) - g_t|_w^2 / G + price |a_t|_1 + ridge/2 |a_t|^2 ) + smooth/2 sum_t |a_t - a_t-1|^2
//
//   a_t   activations of muscles, jaw, gaze, tongue, pressure in the mouth, each within its range
//   u     displacement of the face in equilibrium      g   what is given, m
//   w     skin area of a vertex, and a fifth of its mean for vertices of other parts that the shapes move; 1 for landmarks
//   G     |g|_w^2; of a sequence the largest of all frames
//
// Shapes are sought each from rest; frames of a sequence from the one before, then once more backwards between both neighbours.
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
    /// One of these three. A table of "Measured shapes" (.json), or shapes.glb of `risorius shapes`.
    std::filesystem::path shapes = {};
    std::vector<std::filesystem::path> meshes = {};  ///< the rig's mesh with its vertices elsewhere
    std::filesystem::path landmarks = {};  ///< a table: time_s, ID.x_mm, ID.y_mm, ID.z_mm, ...
    std::vector<std::string> only = {};    ///< of `shapes`; empty: all
    std::string quality = "preview";
    double price = 2e-4, ridge = 2e-4, smooth = 2e-2;
    int fps = 30;     ///< frames of a sequence that are sought, at most so many a second
    int threads = 0;  ///< shapes sought at a time; results do not depend on it
};

/// A shape, or a frame.
struct SolvedDrive {
    std::string name;
    double time_s = 0;  ///< of a frame
    track::Drive drive;
    double rms_m = 0, greatest_m = 0;  ///< of u - g over what counts
    double given_rms_m = 0;            ///< of g
    double highest = 0;                ///< of all activations of muscles
};

struct SolveReport {
    std::string name, rig, given;
    bool sequence = false;
    int points = 0;  ///< vertices or landmarks that count
    track::ChannelTable channels;
    std::vector<SolvedDrive> solved;

    double rms_m() const;  ///< of all, each as heavy
    Json json() const;
};

/// Writes OUT/script.json, which `render` plays, and OUT/results.json; both or none. Throws Error, Interrupted.
SolveReport solve_activations(const SolveOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
