// SPDX-License-Identifier: MIT
/// \file
/// Two scripts, or two heads under one script, side by side in one video.
#pragma once

#include "risorius/animate/render_request.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::animate {

/// The two sides may differ in script and rig. Size, frame rate, coding and sound are those of the left side. The video lasts as
/// long as the longer side; the shorter side stays at its last frame.
///
/// Writes left.out, OUT.json (the records of both sides), OUT.left.frames.tsv and OUT.right.frames.tsv. Throws Error, RunError and
/// Interrupted.
Json compare(const RenderRequest& left, const RenderRequest& right,
             const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
