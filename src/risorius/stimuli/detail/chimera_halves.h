// SPDX-License-Identifier: MIT
/// \file
/// The two halves of a chimeric clip: the lower one is rendered, and what is seen to move is measured in each of them. A landmark belongs to
/// the half that shows it in the first frame (chimera.h). Each half is measured on its own head, with its own twin (seen_motion.h), and
/// its full_mm is the way of its landmarks alone when its own expression is settled at full intensity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/image.h"
#include "risorius/stimuli/detail/chimera.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

/// The lower half, rendered whole.
struct LowerHalf {
    animate::RenderJob job;
    std::vector<Image> frames;
    animate::FrameRows rows;
    std::optional<int> frame;  ///< of the script, in a set of pictures
};
LowerHalf lower_half(const ClipPlan& plan, const ClipWorker& worker);

/// What is seen to move in each half. seen_mm is 0 in a half that stands still.
struct HalfMotions {
    SeenMotion upper, lower;
};

/// Measures the halves of a video. `upper`: the job and the rows of the upper half; `order`: for each shown frame, its row.
HalfMotions half_motions(const ClipPlan& plan, const animate::RenderJob& upper_job,
                         const animate::FrameRows& upper, const LowerHalf& lower,
                         const Chimera& chimera, const std::vector<int>& order,
                         const ClipWorker& worker);

/// Does the same for a picture, which shows the frame `frame` of the upper half's script.
HalfMotions half_motions(const ClipPlan& plan, int frame, const animate::FrameRows& upper,
                         const LowerHalf& lower, const Chimera& chimera, const ClipWorker& worker);

/// Returns the object "upper" or "lower" of the sidecar.
Json json_of_half(const SeenMotion& half);

}  // namespace risorius::stimuli
