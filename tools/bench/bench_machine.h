// How fast this machine steps solids, and simulates, draws and writes faces: medians, so that one slow moment does not count.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::bench {

struct BenchOptions {
    std::vector<std::filesystem::path> rigs;  ///< empty: the adult of this toolkit
    bool faces = true;                        ///< or only solids
    int stress_steps =
        0;         ///< > 0: only drive the faces at random for so many steps (face/solver/stress.h)
    int seed = 1;  ///< of that
    std::string quality = "preview";    ///< of that
    bool only_steps = false;            ///< of the faces
    bool only_poses = false;            ///< likewise; nothing else measures equilibria
    bool only_pictures = false;         ///< and pictures (bench_pictures.h)
    bool only_shapes = false;           ///< and blend shapes (bench_shapes.h)
    std::filesystem::path shapes = {};  ///< of only_shapes; empty: linear ones
};

/// The report: machine, solids of cells (bench_solids.h), and per rig the size of the model, ms per simulated step of 1/60 s at every quality,
/// how far those steps are from converged ones (bench_steps.h), frames per second of pictures (bench_pictures.h), what a frame of blend shapes costs (bench_shapes.h), and the whole way from script to video against real time. Every rig plays the same four seconds.
Json bench_machine(const BenchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
