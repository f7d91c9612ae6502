#include "risorius/stimuli/detail/take.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/media/sha256.h"
#include "risorius/media/video_reader.h"
#include "risorius/report/atomic_file.h"
#include "risorius/scene/face_oval.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

fs::path take_file(const std::string& clip, const char* ending) {
    return fs::path("takes") / (clip + ending);
}

std::optional<Take> whole_take(const ClipPlan& plan, const std::string& clip,
                               const fs::path& folder) {
    const fs::path record_file = folder / take_file(clip, ".json");
    if (!fs::exists(record_file)) return {};
    try {
        const Json record = JsonCursor::read_file(record_file).json();
        if (record.at("film_sha256") != plan.film_sha256) return {};
        Take take;
        take.video = folder / take_file(clip, ".mkv");
        const fs::path table = folder / take_file(clip, ".tsv");
        if (record.at("video_sha256") != media::sha256_of_file(take.video) ||
            record.at("table_sha256") != media::sha256_of_file(table))
            return {};
        take.run = record.at("run");
        take.table = text_of_file(table);
        take.luminance = sums_of(record.at("luminance"));
        return take;
    } catch (const std::exception&) {
        return {};  // something else, or half of it: made again
    }
}

}  // namespace

Json json_of(const media::LuminanceSums& sums) {
    return {{"weight", sums.weight}, {"sum", sums.sum}, {"squares", sums.squares}};
}

media::LuminanceSums sums_of(const Json& json) {
    return {json.at("weight").get<double>(), json.at("sum").get<double>(),
            json.at("squares").get<double>()};
}

std::vector<std::uint16_t> measured_part(const ClipPlan& plan, const animate::FrameRows& rows,
                                         int frame) {
    if (!plan.luminance || !plan.luminance->within_face) return {};
    std::vector<Vec2> border;
    for (const std::string& id : scene::FaceOval::landmarks()) {
        const int u = rows.column(id + ".u_px"), v = rows.column(id + ".v_px");
        if (u >= 0 && v >= 0) border.emplace_back(rows.number(frame, u), rows.number(frame, v));
    }
    if (border.size() < 3)
        throw Error(plan.condition.clip, "a rig with landmarks around the face",
                    std::to_string(border.size()));
    const scene::FaceOval oval(std::move(border));
    std::vector<std::uint16_t> out(static_cast<std::size_t>(plan.width_px) *
                                   static_cast<std::size_t>(plan.height_px));
    for (int y = 0; y < plan.height_px; ++y) {
        const scene::FaceOval::Span inside = oval.pixels_of_row(y, plan.width_px);
        for (int x = inside.first; x < inside.end; ++x)
            out[static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px) +
                static_cast<std::size_t>(x)] = 1;
    }
    return out;
}

std::optional<Take> find_take(const ClipPlan& plan, const fs::path& folder) {
    if (std::optional<Take> own = whole_take(plan, plan.condition.clip, folder)) return own;
    return whole_take(plan, plan.condition.of, folder);
}

void make_take(const ClipPlan& plan, const fs::path& folder, const CoreShare& share,
               const ProgressMonitor& monitor, animate::Studio& studio) {
    const std::string& clip = plan.condition.clip;
    const fs::path video_file = folder / take_file(clip, ".mkv"),
                   table_file = folder / take_file(clip, ".tsv"),
                   record_file = folder / take_file(clip, ".json");
    fs::create_directories(video_file.parent_path());
    fs::remove(record_file);
    write_clip_script(plan, folder);

    const animate::AnimateOptions options = film_options(plan, folder, video_file, share);
    const animate::Shot shot = animate::plan_shot(options);
    media::VideoWriter video(video_file, shot.video);
    animate::FilmExtras extras;
    const animate::RunRecord run = animate::film(
        options, shot, [&](const Image& image) { video.append(image); }, extras, monitor, studio);
    video.finish();
    report::write_text(table_file, extras.table);

    // Measured as it will be read
    const animate::FrameRows rows = animate::frame_rows(extras.table);
    media::VideoReader reader(video_file);
    media::LuminanceSums sums;
    for (int frame = 0; frame < reader.frames(); ++frame)
        sums.add(reader.frame(frame), measured_part(plan, rows, frame));
    report::write_text(record_file, Json{{"film_sha256", plan.film_sha256},
                                         {"video_sha256", media::sha256_of_file(video_file)},
                                         {"table_sha256", media::sha256_of_file(table_file)},
                                         {"luminance", json_of(sums)},
                                         {"run", run_without_places(run)}}
                                            .dump(1) +
                                        "\n");
}

std::optional<media::LuminanceSums> measured_luminance(const ClipPlan& plan,
                                                       const fs::path& folder) {
    try {
        const fs::path take = folder / take_file(plan.condition.clip, ".json");
        if (fs::exists(take)) {
            const Json record = JsonCursor::read_file(take).json();
            if (record.at("film_sha256") == plan.film_sha256)
                return sums_of(record.at("luminance"));
        }
        if (fs::exists(folder / clip_files(plan).sidecar)) {
            const Json record = clip_record(plan, folder);
            if (record.at("luminance").at("film_sha256") == plan.film_sha256)
                return sums_of(record.at("luminance").at("before"));
        }
    } catch (const std::exception&) {
        return {};  // of something else
    }
    return {};
}

void remove_take(const ClipPlan& plan, const fs::path& folder) {
    for (const char* ending : {".json", ".tsv", ".mkv"}) {
        std::error_code ignored;
        fs::remove(folder / take_file(plan.condition.clip, ending), ignored);
    }
}

}  // namespace risorius::stimuli
