// SPDX-License-Identifier: MIT
// Where landmarks will be in a picture is known before the face is simulated.
#include "risorius/animate/planned_landmarks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/track/timeline.h"
#include "temporary_folder.h"

namespace risorius::animate {
namespace {

TEST(PlannedLandmarks, AreWhereTheTableOfFramesHasThem) {
    const TemporaryFolder folder;
    RenderSession session;
    RenderInputs inputs;
    for (const char* camera : {"front", "three_quarter"}) {
        Json script = Json::parse(R"({"format": "risorius-script", "version": 1, "fps": 10,
            "duration_s": 0.2,
            "channels": {"head_yaw_deg": {"keys": [[0, 12], [0.2, -8]]},
                         "head_roll_deg": {"keys": [[0, 5], [0.2, 5]]},
                         "zygomaticus_major": {"keys": [[0, 0.6], [0.2, 0.6]]}},
            "view": {"width_px": 96, "height_px": 64, "antialiasing": 1}})");
        script["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
        script["view"]["camera"] = camera;
        RenderRequest request;
        request.script = folder / "script.json";
        request.script_in_memory = JsonCursor::from_json(script, request.script.string());
        request.out = folder / "none.mkv";
        request.draft = true;
        request.landmarks = true;
        request.threads = 1;
        const RenderJob job = plan_render_job(request, inputs);
        const PlannedLandmarks planned(job);
        const track::ChannelTable channels = job.rig->files.rig.channels();
        const track::Timeline timeline(job.script, channels);
        const FrameRows rows = frame_rows(run_render_job(job, session, [](Image) {}, {}).table);
        for (int frame = 0; frame < 2; ++frame) {
            const int left = rows.column("zy_l.u_px"), right = rows.column("zy_r.u_px");
            const double shown_px =
                std::hypot(rows.number(frame, left) - rows.number(frame, right),
                           rows.number(frame, left + 1) - rows.number(frame, right + 1));
            // The zygion lies on the skin, which the muscle moves a little.
            EXPECT_NEAR(planned.distance_px("zy_l", "zy_r", timeline.at(job.time_s(frame))),
                        shown_px, 0.01 * shown_px + 0.05)
                << camera << " " << frame;
        }
    }
}

}  // namespace
}  // namespace risorius::animate
