// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of static equilibria on shells of increasing size: iterations, time and remaining error.
///
///   left    maximum displacement of a node when the equilibrium is solved again, from the solution, with a tolerance 100 times smaller
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

struct PoseBench {
    std::vector<int> shell_vertices{800, 1700, 3300,
                                    6600};  ///< about 2, 5, 10 and 20 thousand nodes
    std::vector<std::string> units{"AU12", "AU9", "AU26", "AU18", "AU28_lower"};
};

/// For each shell: shell_vertices, nodes, tets and poses, each with name, iterations, seconds (of one core), at_rest, inverted
/// (tetrahedra) and left_mm. Throws Error when the rig's tables do not know a unit.
Json bench_poses(const scene::RigFiles& files, const PoseBench& bench = {},
                 const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
