// How fast pictures of a face come out, from simulation to video file: at 512 x 512, 1024 x 1024 and 1920 x 1080, as usual
// and as drafts (AnimateOptions::draft).
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

/// Two seconds of 30 frames a second: a smile, surprise, a blink, idling. Per size and draft or not: `fps`, frames over wall time
/// on all cores, once all threads have drawn; and of one frame the processor time of all threads, ms, medians:
/// `simulate_ms`, `draw_ms`, `read_back_ms` (samples to pixels, into memory), `measure_ms` (luminance, hash), `encode_ms` (mean). Scratch
/// files go to the folder.
Json bench_pictures(const scene::RigFiles& files, const std::filesystem::path& folder,
                    const ProgressMonitor& monitor);

}  // namespace risorius::bench
