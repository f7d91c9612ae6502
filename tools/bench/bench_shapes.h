// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of a frame of blend shapes: weights of a drive, sum of the shapes, and rotation of eyes, head and neck.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

/// The shapes of `file` (shapes.glb of `risorius shapes`) and their correctives play the track of bench_steps.h on a turned head.
/// Without a file, the 52 shapes of ARKit are used in linearized form: they move as many vertices as solved shapes, are made in
/// seconds and have no correctives. Returns `shapes`, `correctives`, `vertices`, `moved_vertices` (of all shapes and correctives)
/// and `frames`; and CPU times of one core, ms: `frame_ms` (median), `slowest_frame_ms` and `weights_ms` (computation of the
/// weights, median).
Json bench_shapes(const scene::RigFiles& files, const std::filesystem::path& file,
                  const ProgressMonitor& monitor);

}  // namespace risorius::bench
