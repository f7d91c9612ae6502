// SPDX-License-Identifier: MIT
#include "tools/bench/bench_pictures.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "risorius/animate/animate.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/json_object.h"
#include "risorius/core/sha256.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/media/luminance.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/median.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/timeline.h"

namespace risorius::bench {

namespace fs = std::filesystem;

namespace {

constexpr animate::PictureSize kSizes[] = {{512, 512}, {1024, 1024}, {1920, 1080}};
/// Frames until every thread has made its view and compiled its shaders
constexpr std::size_t kWarmUp = 12;
constexpr int kDrawnEvery = 4;  ///< every fourth frame is drawn when stages are timed separately

Json script_of(const fs::path& rig) {
    Json script = Json::parse(R"({
        "format": "risorius-script", "version": 1, "fps": 30, "duration_s": 2.0, "seed": 1,
        "events": [{"expression": "happiness", "start_s": 0.1, "onset_s": 0.3, "hold_s": 0.3, "offset_s": 0.3},
                   {"expression": "surprise", "start_s": 1.1, "onset_s": 0.2, "hold_s": 0.3, "offset_s": 0.3},
                   {"blink": {}, "start_s": 0.6}, {"idle": {"blinks_per_minute": 0}}]
    })");
    script["rig"] = fs::absolute(rig).generic_string();
    return script;
}

// Mean CPU time of the passes of a picture, ms.
Json passes_of(render::OffscreenView& view, const render::Pose& pose) {
    constexpr int kPictures = 10;
    view.time_passes();
    for (int k = 0; k < kPictures; ++k) view.draw(pose);
    Json out = Json::object();
    for (const auto& [name, seconds] : view.passes_s()) out[name] = 1e3 * seconds / kPictures;
    return out;
}

// Runs the stages of a job one after another, to time each separately.
Json stages(const animate::RenderJob& job) {
    const scene::RigFiles& files = job.rig->files;
    const track::ChannelTable channels = files.rig.channels();
    const track::Timeline timeline(job.script, channels);
    const auto drive = [&](double t_s) { return timeline.at(t_s); };
    face::Face face(files.rig, files.mesh, job.quality, files.place());
    render::Scene scene = scene::scene_from_rig(face.head(), files.rig, files.mesh);
    scene::add_wrinkles(face.surfaces().wrinkle_lines(), scene);
    render::OffscreenView view(scene, job.view);

    std::vector<double> simulate, draw, read_back, measure;
    std::vector<Image> images;
    media::LuminanceMeter meter;
    Sha256 hash;
    face.start(drive);
    const auto ms = [](const auto& stopwatch) { return 1e3 * stopwatch.seconds(); };
    for (int frame = 0; frame < job.frames; ++frame) {
        const report::ProcessStopwatch simulating;
        const render::Pose pose = scene::pose_for_view(face.pose_at(job.time_s(frame), drive));
        if (frame > 0) simulate.push_back(ms(simulating));
        if (frame % kDrawnEvery != 0) continue;
        if (frame == 0) view.draw(pose);  // the driver compiles its shaders
        const report::ProcessStopwatch drawing;
        images.push_back(view.draw(pose));
        const double drawn_ms = ms(drawing);
        read_back.push_back(1e3 * view.read_back_s());
        draw.push_back(drawn_ms - read_back.back());
        const report::ProcessStopwatch measuring;
        meter.measure(images.back());
        hash.add(images.back().rgba.data(), images.back().rgba.size());
        measure.push_back(ms(measuring));
    }
    const Json passes = passes_of(view, scene::pose_for_view(face.pose()));
    const report::ProcessStopwatch encoding;
    media::VideoWriter video(job.out, job.video);
    for (int frame = 0; frame < job.frames; ++frame)
        video.append(images[static_cast<std::size_t>(frame / kDrawnEvery)]);
    video.finish();
    return json_object({{"simulate_ms", report::median(simulate)},
                        {"draw_ms", report::median(draw)},
                        {"read_back_ms", report::median(read_back)},
                        {"measure_ms", report::median(measure)},
                        {"encode_ms", ms(encoding) / job.frames},
                        {"passes_ms", passes}});
}

}  // namespace

Json bench_pictures(const scene::RigFiles& files, const fs::path& folder,
                    const ProgressMonitor& monitor) {
    animate::RenderRequest request;
    request.script = folder / "pictures.json";
    request.script_in_memory =
        JsonCursor::from_json(script_of(files.file), request.script.string());
    request.out = folder / "pictures.mp4";
    animate::RenderInputs inputs;
    Json out = Json::array();
    for (const animate::PictureSize& size : kSizes)
        for (const bool draft : {false, true}) {
            monitor.report(static_cast<double>(out.size()) / 6, "pictures");
            request.size = size;
            request.draft = draft;
            // The number of driver threads is fixed by the first view of a process: all of them, for both measurements.
            request.threads = static_cast<int>(std::max(2U, std::thread::hardware_concurrency()));
            std::vector<double> shown_s;
            const report::Stopwatch since;
            const animate::RunRecord record =
                animate::animate(request, {[&](double, const std::string& what) {
                                               if (what == animate::kRendering)
                                                   shown_s.push_back(since.seconds());
                                           },
                                           monitor.stopped});
            Json one = json_object({{"width_px", size.width_px},
                                    {"height_px", size.height_px},
                                    {"draft", draft},
                                    {"fps", (record.frames - static_cast<double>(kWarmUp)) /
                                                (since.seconds() - shown_s[kWarmUp])}});
            one.update(stages(animate::plan_render_job(request, inputs)));
            out.push_back(std::move(one));
        }
    return out;
}

}  // namespace risorius::bench
