// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/unmatched_render.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/sha256.h"
#include "risorius/media/luminance.h"
#include "risorius/media/video_reader.h"
#include "risorius/scene/face_oval.h"
#include "risorius/stimuli/detail/picture_frame.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

constexpr double kOvalRim = 0.08;  // of its width

/// The file of a clip with the given extension; `below` is one of kIntermediateFolders.
fs::path intermediate_file(const std::string& clip, const char* ending,
                           const char* below = kIntermediateFolders[0]) {
    return fs::path(below) / (clip + ending);
}

std::optional<UnmatchedRender> complete_render(const ClipPlan& plan, const std::string& clip,
                                               const fs::path& folder, const char* below) {
    const ReadingFormerOutput former;
    const fs::path record_file = folder / intermediate_file(clip, ".json", below);
    if (!fs::exists(record_file)) return {};
    try {
        const Json record = JsonCursor::read_file(record_file).json();
        if (record.at("film_sha256") != plan.render_sha256) return {};
        UnmatchedRender render;
        render.video = folder / intermediate_file(clip, ".mkv", below);
        const fs::path table = folder / intermediate_file(clip, ".tsv", below);
        if (record.at("video_sha256") != sha256_of_file(render.video) ||
            record.at("table_sha256") != sha256_of_file(table))
            return {};
        render.run = record.at("run");
        render.table = text_of_file(table);
        render.luminance = sums_of(record.at("luminance"));
        render.colours = record.at("colours");
        if (plan.clips.pictures()) render.picture = picture_of(record.at("picture"));
        return render;
    } catch (const std::exception&) {
        return {};  // another or an incomplete file: the clip is rendered again
    }
}

}  // namespace

Json json_of(const media::LuminanceSums& sums) {
    return json_object({{"weight", sums.weight}, {"sum", sums.sum}, {"squares", sums.squares}});
}

media::LuminanceSums sums_of(const Json& json) {
    return {json.at("weight").get<double>(), json.at("sum").get<double>(),
            json.at("squares").get<double>()};
}

std::vector<float> weights_in_oval(const ClipPlan& plan, const animate::FrameRows& rows, int frame,
                                   const Image& picture) {
    std::vector<Vec2> border;
    for (const std::string& id : scene::FaceOval::landmarks()) {
        const int u = rows.column(id + ".u_px"), v = rows.column(id + ".v_px");
        if (u >= 0 && v >= 0) border.emplace_back(rows.number(frame, u), rows.number(frame, v));
    }
    if (border.size() < 3)
        throw Error(plan.condition.clip, "a rig with landmarks around the face",
                    std::to_string(border.size()));
    std::vector<float> out = scene::FaceOval(std::move(border))
                                 .soft_pixels(picture.width_px, picture.height_px, kOvalRim);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] *= static_cast<float>(media::opacity_of(picture, i));
    return out;
}

std::vector<float> measured_weights(const ClipPlan& plan, const animate::FrameRows& rows, int frame,
                                    const Image& picture) {
    std::vector<float> out(picture.rgba.size() / 4, 1);
    if (plan.luminance && plan.luminance->within_face)
        out = weights_in_oval(plan, rows, frame, picture);
    // What shows the background in part has a luminance that no map reaches.
    for (std::size_t i = 0; i < out.size(); ++i)
        if (media::opacity_of(picture, i) < 1) out[i] = 0;
    return out;
}

std::optional<UnmatchedRender> find_unmatched_render(const ClipPlan& plan, const fs::path& folder) {
    for (const std::string& clip : {plan.condition.clip, plan.condition.of})
        for (const char* below : kIntermediateFolders)
            if (std::optional<UnmatchedRender> found = complete_render(plan, clip, folder, below))
                return found;
    return {};
}

void make_unmatched_render(const ClipPlan& plan, const ClipWorker& worker) {
    const std::string& clip = plan.condition.clip;
    const fs::path& folder = worker.folder;
    OutputSet outputs(folder, OutputSet::Then::kRunGoesOn);
    // The record first: it tells that the folder is one of `batch`.
    const fs::path record_file = outputs.file(folder / intermediate_file(clip, ".json")),
                   video_file = outputs.file(folder / intermediate_file(clip, ".mkv")),
                   table_file = outputs.file(folder / intermediate_file(clip, ".tsv"));

    std::optional<SeenPicture> picture;
    if (plan.clips.pictures()) picture = picture_frame(plan, worker);
    animate::RenderJob job = render_job_of(
        plan, video_file, {}, worker, picture ? std::optional<int>(picture->frame) : std::nullopt);
    job.view.background.transparent = job.video.alpha = true;
    job.video.bits = 16;  // a map of small contrast stretches steps of bytes until they are seen
    job.view.deep = job.view.show == render::Show::kSkin;
    media::VideoWriter video(video_file, job.video);
    const animate::RenderResult result = animate::run_render_job(
        job, worker.session, [&](const Image& image) { video.append(image); }, worker.monitor);
    video.finish();
    write_file(table_file, result.table);

    // Luminance is measured on the decoded pictures.
    const animate::FrameRows rows = animate::frame_rows(result.table);
    const ReadingFormerOutput own;
    media::VideoReader reader(video_file);
    MeasuredLuminance measured;
    for (int frame = 0; frame < reader.frames(); ++frame) {
        const Image image = reader.frame(frame);
        const std::vector<float> weights = measured_weights(plan, rows, frame, image);
        measured.sums.add(image, weights);
        measured.colours.add(image, weights);
    }
    Json record = json_object({{"design", plan.design},
                               {"film_sha256", plan.render_sha256},
                               {"video_sha256", sha256_of_file(video_file)},
                               {"table_sha256", sha256_of_file(table_file)},
                               {"luminance", json_of(measured.sums)},
                               {"colours", measured.colours.text()},
                               {"run", portable_record(result.record)}});
    if (picture) record["picture"] = json_of(*picture);
    write_file(record_file, json_text(record, 1) + "\n");
    worker.monitor.throw_if_stopped();
    outputs.commit();
}

std::optional<MeasuredLuminance> measured_luminance(const ClipPlan& plan, const fs::path& folder) {
    const ReadingFormerOutput former;
    try {
        for (const char* below : kIntermediateFolders) {
            const fs::path file = folder / intermediate_file(plan.condition.clip, ".json", below);
            if (!fs::exists(file)) continue;
            const Json record = JsonCursor::read_file(file).json();
            if (record.at("film_sha256") == plan.render_sha256)
                return MeasuredLuminance{sums_of(record.at("luminance")),
                                         media::ColourSums::of_text(record.at("colours"))};
        }
        if (fs::exists(folder / clip_files(plan).sidecar)) {
            const Json luminance = clip_record(plan, folder).at("luminance");
            if (luminance.at("film_sha256") == plan.render_sha256)
                return MeasuredLuminance{sums_of(luminance.at("before")),
                                         media::ColourSums::of_text(luminance.at("colours"))};
        }
    } catch (const std::exception&) {
        return {};  // it belongs to another script
    }
    return {};
}

void remove_unmatched_render(const ClipPlan& plan, const fs::path& folder) {
    for (const char* below : kIntermediateFolders) {
        if (!complete_render(plan, plan.condition.clip, folder, below)) continue;
        for (const char* ending : {".mkv", ".tsv", ".json"}) {
            std::error_code ignored;
            fs::remove(folder / intermediate_file(plan.condition.clip, ending, below), ignored);
        }
    }
}

}  // namespace risorius::stimuli
