// SPDX-License-Identifier: MIT
#include "risorius/animate/compare.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/sha256.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/lettering.h"
#include "risorius/report/output_paths.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

constexpr int kGap_px = 4;

Image joined(const Image& left, const Image& right) {
    Image out(left.width_px + kGap_px + right.width_px, left.height_px);
    for (std::size_t i = 0; i < out.rgba.size(); ++i)  // white between the sides
        out.rgba[i] = 255;
    for (int y = 0; y < left.height_px; ++y) {
        std::copy_n(left.pixel(0, y), 4 * left.width_px, out.pixel(0, y));
        std::copy_n(right.pixel(0, y), 4 * right.width_px, out.pixel(left.width_px + kGap_px, y));
    }
    return out;
}

/// The name of what differs between the sides: the script, or else the rig.
std::string caption_of(const RenderJob& side, const RenderJob& other) {
    const fs::path& file = side.script_file.path != other.script_file.path ? side.script_file.path
                                                                           : side.rig->files.file;
    const fs::path whole = fs::absolute(file).lexically_normal();
    return whole.parent_path().filename().string() + "/" + whole.stem().string();
}

void write_caption(const std::string& text, Image& image) {
    const double height = std::max(7.0, image.height_px / 48.0);
    render::write_text(text, {height, image.height_px - height},
                       {.height_px = height, .ink = 0.05, .rim = 0.7}, image);
}

}  // namespace

Json compare(const RenderRequest& left_request, const RenderRequest& right_request,
             const ProgressMonitor& monitor) {
    // Plan both sides; they are equal except for what is compared.
    RenderInputs inputs(monitor);
    const RenderJob left = plan_render_job(left_request, inputs);
    RenderRequest alike = right_request;
    alike.out = left.out;
    alike.fps = left.fps;
    alike.size = PictureSize{left.view.width_px, left.view.height_px};
    alike.camera = left.view.camera;
    alike.marks = {};  // the marks of the left side are sufficient
    const RenderJob right = plan_render_job(alike, inputs);
    media::VideoOptions coding = left.video;
    coding.width_px = 2 * left.view.width_px + kGap_px;
    media::check_target(left.out, coding);
    const fs::path record = report::output_path(left.out, ".json"),
                   tables[] = {report::output_path(left.out, ".left.frames.tsv"),
                               report::output_path(left.out, ".right.frames.tsv")};
    report::check_record(record);
    for (const fs::path& table : tables) report::check_table(table);
    OutputSet outputs(folder_of_output(left.out));
    const bool of_frames = !left.out.has_filename();
    const fs::path out = of_frames ? outputs.folder(left.out) / "" : outputs.file(left.out);
    const fs::path record_text = outputs.file(record);
    const fs::path table_text[] = {outputs.file(tables[0]), outputs.file(tables[1])};
    media::VideoWriter video(out, coding);

    const auto half = [&](double begun) {
        ProgressMonitor part = monitor;
        if (monitor.progress)
            part.progress = [&monitor, begun](double fraction, const std::string& what) {
                monitor.progress(begun + 0.5 * fraction, what);
            };
        return part;
    };
    const auto run = [&](const RenderJob& job, const ProgressMonitor& part, const auto& use) {
        RenderSession session;
        return run_render_job(job, session, use, part);
    };
    // A lossless video of the left side, until the right side is rendered
    const fs::path kept = outputs.scratch_file("left.mkv");
    const std::string captions[] = {caption_of(left, right), caption_of(right, left)};
    RenderResult results[2];
    {
        media::VideoWriter side(kept, {.width_px = left.view.width_px,
                                       .height_px = left.view.height_px,
                                       .fps = left.fps,
                                       .alpha = left.video.alpha});
        results[0] = run(left, half(0), [&](Image image) {
            write_caption(captions[0], image);
            side.append(image);
        });
        side.finish();
    }
    const ReadingFormerOutput own;
    media::VideoReader before(kept);
    Image on_left, on_right;
    int shown = 0;
    const auto show = [&] {
        if (shown < before.frames()) on_left = before.frame(shown);
        video.append(joined(on_left, on_right));
        ++shown;
    };
    results[1] = run(right, half(0.5), [&](Image image) {
        write_caption(captions[1], image);
        on_right = std::move(image);
        show();
    });
    while (shown < before.frames()) show();

    // All files appear together, or none.
    Json json = json_object({{"format", "risorius-comparison"}, {"version", 1}, {"frames", shown}});
    json["left"] = results[0].record.json();
    json["right"] = results[1].record.json();
    video.finish();
    if (!of_frames) json["out_sha256"] = sha256_of_file(out);
    for (std::size_t side = 0; side < 2; ++side) write_file(table_text[side], results[side].table);
    write_file(record_text, json_text(json, 2) + "\n");
    monitor.report(1, "done");
    outputs.commit();
    return json;
}

}  // namespace risorius::animate
