// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/picture_frame.h"

#include <algorithm>
#include <cmath>

#include "risorius/animate/landmark_run.h"
#include "risorius/core/json_object.h"

namespace risorius::stimuli {

SeenPicture picture_frame(const ClipPlan& plan, const ClipWorker& worker) {
    const animate::RenderJob job = render_job_of(plan, worker.folder / "none.mkv", {}, worker);
    const animate::LandmarkFrames frames =
        animate::play_landmarks(job, worker.session, worker.monitor);
    std::optional<animate::LandmarkFrames> twin;
    if (const auto without = animate::job_without_expression(job))
        twin = animate::play_landmarks(*without, worker.session, worker.monitor);
    std::optional<int> frame;
    if (plan.clips.still_s)
        frame = std::min(static_cast<int>(std::lround(*plan.clips.still_s * plan.fps)),
                         plan.script_frames - 1);
    return seen_picture(frames, twin, frame);
}

Json json_of(const SeenPicture& picture) {
    return json_object({{"frame", picture.frame},
                        {"seen_mm", picture.seen_mm},
                        {"seen_landmark", picture.landmark}});
}

SeenPicture picture_of(const Json& json) {
    return {json.at("frame").get<int>(), json.at("seen_mm").get<double>(),
            json.at("seen_landmark").get<std::string>()};
}

}  // namespace risorius::stimuli
