// What a frame of blend shapes costs: weights from a drive, shapes added up, eyes, head and neck turned.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

/// The shapes of `file` (shapes.glb of `risorius shapes`) with their correctives play the track of bench_steps.h on a head that is
/// turned. Without a file, the 52 shapes of ARKit, taken to be linear in their drives, which tells as well as solved ones do how many
/// vertices each moves, takes seconds to make, and has no correctives. `shapes`, `correctives`, `vertices`, `moved_vertices` (of all
/// shapes and correctives), `frames`; processor time of one core, ms: `frame_ms` (median), `slowest_frame_ms`, `weights_ms` (median,
/// of that).
Json bench_shapes(const scene::RigFiles& files, const std::filesystem::path& file,
                  const ProgressMonitor& monitor);

}  // namespace risorius::bench
