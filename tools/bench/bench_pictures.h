// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of rendering, from simulation to video file, at 512 x 512, 1024 x 1024 and 1920 x 1080, with and without
/// RenderRequest::draft.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

/// Renders two seconds at 30 frames per second: a smile, surprise, a blink and idle motion. Returns for each size, with and
/// without draft: `fps`, frames per second of wall time on all cores, measured after all threads have drawn once; and medians of
/// the CPU time per frame over all threads, ms: `simulate_ms`, `draw_ms`, `read_back_ms` (from samples to pixels in memory),
/// `measure_ms` (luminance and hash) and `encode_ms` (a mean); and `passes_ms`, the mean CPU time of each pass of the drawing. Temporary files are written to the folder.
Json bench_pictures(const scene::RigFiles& files, const std::filesystem::path& folder,
                    const ProgressMonitor& monitor);

}  // namespace risorius::bench
