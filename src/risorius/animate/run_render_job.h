// SPDX-License-Identifier: MIT
/// \file
/// Runs a planned render from its first frame to its last: simulates, draws, measures and marks.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "risorius/animate/detail/pass_writer.h"
#include "risorius/animate/detail/run_record.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/image.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::animate {

/// The stage that the monitor reports while frames are drawn.
inline constexpr const char* kRendering = "rendering";

/// A function that receives the pictures in order. With several threads, it is called on a thread of its own.
using UsePicture = std::function<void(Image)>;

struct RenderResult {
    RunRecord record;
    std::string table;  ///< the text of frame_table.h
    /// Complete, but not yet given its final name (PassWriter::commit()); null when the job has no passes
    std::unique_ptr<PassWriter> passes;
};

/// Runs a job. Throws Error for wrong input and Interrupted when the monitor asks to stop. A session that has run a similar job
/// before makes the frames faster.
RenderResult run_render_job(const RenderJob& job, RenderSession& session, const UsePicture& use,
                            const ProgressMonitor& monitor);

}  // namespace risorius::animate
