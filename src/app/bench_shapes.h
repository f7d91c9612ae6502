// What a frame of blend shapes costs: weights from a drive, shapes added up, eyes, head and neck turned.
#pragma once

#include "app/rig_files.h"
#include "app/watch.h"
#include "core/json_cursor.h"

namespace risorius::app {

/// The 52 shapes of ARKit play the track of bench_steps.h. They are taken to be linear in their drives, which tells as well as solved
/// ones do how many vertices each moves, and takes seconds to make. `shapes`, `vertices`, `moved_vertices` (of all shapes),
/// `frames`; processor time of one core, ms: `frame_ms` (median), `slowest_frame_ms`, `weights_ms` (median, of that).
Json bench_shapes(const RigFiles& files, const Watch& watch);

}  // namespace risorius::app
