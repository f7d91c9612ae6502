// How static equilibria are found on shells of growing size: iterations, time, and what is left where it says that it rests.
//
//   left    how far any node still goes when the pose is settled once more, from where it stood and ended a hundred times closer
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

/// Per shell: shell_vertices, nodes, tets and poses, each with name, iterations, seconds (of one core), at_rest, inverted
/// (tetrahedra) and left_mm. Throws Error when the rig's tables do not know a unit.
Json bench_poses(const scene::RigFiles& files, const PoseBench& bench = {},
                 const ProgressMonitor& monitor = {});

}  // namespace risorius::bench
