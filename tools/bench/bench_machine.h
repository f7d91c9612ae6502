// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of this machine: steps of solids, and simulation, drawing and encoding of faces. Times are medians.
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
    bool only_steps = false;          ///< measure only steps of the faces
    bool only_poses =
        false;  ///< measure only equilibria (bench_poses.h), which no other option does
    bool only_pictures = false;         ///< measure only pictures (bench_pictures.h)
    bool only_shapes = false;           ///< measure only blend shapes (bench_shapes.h)
    std::filesystem::path shapes = {};  ///< file for only_shapes; empty: linear shapes of ARKit
};

/// The report: machine, solids of cells (bench_solids.h), and per rig the size of the model, ms per simulated step of 1/60 s at every quality,
/// how far those steps are from converged ones (bench_steps.h), frames per second of pictures (bench_pictures.h), what a frame of blend shapes costs (bench_shapes.h), and the whole way from script to video against real time. Every rig plays the same four seconds.
Json bench_machine(const BenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
