#include "risorius/animate/compare.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/animate/film.h"
#include "risorius/core/error.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/lettering.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/output_paths.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

constexpr int kGap_px = 4;

/// The pictures of the left side until those of the right are there: without loss, gone with its owner.
class SideFile {
  public:
    explicit SideFile(const fs::path& out)
        : path_(fs::absolute(out.has_filename() ? out : out.parent_path()).parent_path() /
                (".risorius-left-" + std::to_string(::getpid()) + ".mkv")) {}
    ~SideFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    SideFile(const SideFile&) = delete;
    SideFile& operator=(const SideFile&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

Image joined(const Image& left, const Image& right) {
    Image out(left.width_px + kGap_px + right.width_px, left.height_px);
    for (std::size_t i = 0; i < out.rgba.size(); ++i)  // between them white
        out.rgba[i] = 255;
    for (int y = 0; y < left.height_px; ++y) {
        std::copy_n(left.pixel(0, y), 4 * left.width_px, out.pixel(0, y));
        std::copy_n(right.pixel(0, y), 4 * right.width_px, out.pixel(left.width_px + kGap_px, y));
    }
    return out;
}

/// What tells the sides apart.
std::string caption_of(const AnimateOptions& side, const AnimateOptions& other, const Shot& shot) {
    const fs::path& file =
        side.script != other.script ? side.script : fs::path(shot.script.rig_file);
    const fs::path whole = fs::absolute(file).lexically_normal();
    return whole.parent_path().filename().string() + "/" + whole.stem().string();
}

void write_caption(const std::string& text, Image& image) {
    const double height = std::max(7.0, image.height_px / 48.0);
    render::write_text(text, {height, image.height_px - height},
                       {.height_px = height, .ink = 0.05, .rim = 0.7}, image);
}

}  // namespace

Json compare(const AnimateOptions& left, const AnimateOptions& right,
             const ProgressMonitor& monitor) {
    // Plan both, alike but for what is compared
    const Shot first = plan_shot(left);
    AnimateOptions other = right;
    other.out = left.out;
    other.fps = first.script.fps;
    other.size = PictureSize{first.view.width_px, first.view.height_px};
    other.camera = first.view.camera;
    other.marks = {};  // one clock is enough
    const Shot second = plan_shot(other);
    media::VideoOptions coding = first.video;
    coding.width_px = 2 * first.view.width_px + kGap_px;
    media::check_target(left.out, coding);
    const fs::path record = report::output_path(left.out, ".json"),
                   tables[] = {report::output_path(left.out, ".left.frames.tsv"),
                               report::output_path(left.out, ".right.frames.tsv")};
    report::check_record(record);
    for (const fs::path& table : tables) report::check_table(table);
    media::VideoWriter video(left.out, coding);  // makes the folder too

    const auto half = [&](double begun) {
        ProgressMonitor part = monitor;
        if (monitor.progress)
            part.progress = [&monitor, begun](double share, const std::string& what) {
                monitor.progress(begun + 0.5 * share, what);
            };
        return part;
    };
    const SideFile kept(left.out);
    FilmExtras extras[2];
    const std::string captions[] = {caption_of(left, other, first),
                                    caption_of(other, left, second)};
    RunRecord records[2];
    {
        media::VideoWriter side(kept.path(), {.width_px = first.view.width_px,
                                              .height_px = first.view.height_px,
                                              .fps = first.script.fps,
                                              .alpha = first.video.alpha});
        records[0] = film(
            left, first,
            [&](Image image) {
                write_caption(captions[0], image);
                side.append(image);
            },
            extras[0], half(0));
        side.finish();
    }
    media::VideoReader before(kept.path());
    Image on_left, on_right;
    int shown = 0;
    const auto show = [&] {
        if (shown < before.frames()) on_left = before.frame(shown);
        video.append(joined(on_left, on_right));
        ++shown;
    };
    records[1] = film(
        other, second,
        [&](Image image) {
            write_caption(captions[1], image);
            on_right = std::move(image);
            show();
        },
        extras[1], half(0.5));
    while (shown < before.frames()) show();

    // Leave everything or nothing
    Json json{{"format", "risorius-comparison"}, {"version", 1}, {"frames", shown}};
    json["left"] = records[0].json();
    json["right"] = records[1].json();
    report::AtomicFile table_left(tables[0], extras[0].table),
        table_right(tables[1], extras[1].table), both(record, json.dump(2) + "\n");
    video.finish();
    table_left.commit();
    table_right.commit();
    both.commit();
    monitor.report(1, "done");
    return json;
}

}  // namespace risorius::animate
