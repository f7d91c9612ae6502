// SPDX-License-Identifier: MIT
/// \file
/// Plays a script without pictures, and returns where the landmarks of the face are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/core/types.h"

namespace risorius::animate {

struct LandmarkFrames {
    std::vector<std::string> ids;
    std::vector<Points> positions_mm;  ///< per frame: one row per landmark, mm, world frame
};

/// Plays the script of a job. The positions are those in the table of run_render_job().
LandmarkFrames play_landmarks(const RenderJob& job, RenderSession& session,
                              const ProgressMonitor& monitor);

/// Returns two frames: the face at the first frame, and the face in equilibrium with the drive of the frame in which the muscles
/// and the jaw are driven most.
LandmarkFrames settled_landmarks(const RenderJob& job, RenderSession& session);

/// Returns the job with only what moves whatever the face expresses: head, gaze, blinks and idle motion. Empty when its script has none of
/// these.
std::optional<RenderJob> job_without_expression(const RenderJob& job);

}  // namespace risorius::animate
