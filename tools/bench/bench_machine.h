// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of this machine: steps of solids; simulation, drawing and encoding of faces. Times are medians.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::bench {

struct BenchOptions {
    std::vector<std::filesystem::path> rigs;  ///< empty: the adult rig of this toolkit
    bool faces = true;                        ///< false: measure only solids
    int stress_steps = 0;  ///< > 0: only a stress test of this many steps (face/solver/stress.h)
    int seed = 1;          ///< of the stress test
    std::string quality = "preview";  ///< of the stress test
    /// Measure solids and the errors of steps, too, which takes a quarter of an hour
    bool tables = false;
    bool only_steps = false;  ///< measure only steps of the faces
    /// Measure only equilibria (bench_poses.h), which no other option measures
    bool only_poses = false;
    bool only_pictures = false;  ///< measure only pictures (bench_pictures.h)
    bool only_shapes = false;    ///< measure only blend shapes (bench_shapes.h)
    /// Measure only how cost grows with work (bench_growth.h), with the first rig
    bool only_growth = false;
    /// Folder for a chart of only_growth; empty: no chart
    std::filesystem::path growth_chart = {};
    /// File for only_shapes; empty: linear versions of the ARKit shapes
    std::filesystem::path shapes = {};
};

/// The report: machine, with `tables` solids of cells (bench_solids.h), and for each rig the size of the model, ms per simulated step of 1/60 s
/// at every quality, with `tables` the error of these steps (bench_steps.h), frames per second of pictures (bench_pictures.h), the cost of a
/// frame of blend shapes (bench_shapes.h), and the speed of the whole process from script to video relative to real time. Every
/// rig plays the same four seconds.
Json bench_machine(const BenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
