// SPDX-License-Identifier: MIT
/// \file
/// From a script to a video: plans the job, runs it and writes its files.
#pragma once

#include "risorius/animate/detail/run_record.h"
#include "risorius/animate/render_request.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::animate {

/// Writes OUT, OUT.json (the record that is returned) and OUT.frames.tsv: all of them or none. Throws Error for wrong input,
/// RunError when writing fails and Interrupted when the monitor asks to stop.
RunRecord animate(const RenderRequest& request, const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
