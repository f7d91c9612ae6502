#include "risorius/animate/animate.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/animate/film.h"
#include "risorius/animate/shot.h"
#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_writer.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/output_paths.h"
#include "risorius/report/stopwatch.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

// A video, or for a still a single picture.
class Output {
  public:
    Output(const fs::path& out, const Shot& shot, bool still) : out_(out) {
        if (!still) video_.emplace(out, shot.video);
    }
    void append(Image image) {
        if (video_)
            video_->append(image);
        else
            still_ = std::move(image);
    }
    void finish() {
        if (video_)
            video_->finish();
        else if (!still_.deep.empty())
            media::write_png16(still_, out_);
        else
            media::write_png(still_, out_);
    }

  private:
    fs::path out_;
    std::optional<media::VideoWriter> video_;
    Image still_;
};

}  // namespace

RunRecord animate(const AnimateOptions& options, const ProgressMonitor& monitor) {
    const report::Stopwatch total;
    if (options.out.extension() == ".png" && !options.still_s)
        throw Error(
            options.out.string(),
            option_name("still_s") +
                " with it, the name of a video, or of a folder of PNG frames, which ends in /",
            "\".png\" alone");
    const Shot shot = plan_shot(options);
    report::check_record(report::output_path(options.out, ".json"));
    report::check_table(report::output_path(options.out, ".frames.tsv"));
    Output output(options.out, shot, options.still_s.has_value());

    // One picture per frame
    FilmExtras extras;
    extras.passes_folder = report::output_path(options.out, ".passes");
    RunRecord record = film(
        options, shot, [&](Image image) { output.append(std::move(image)); }, extras, monitor);

    // Leave everything or nothing
    report::AtomicFile frame_table(report::output_path(options.out, ".frames.tsv"), extras.table);
    const report::Stopwatch closing;
    output.finish();
    if (extras.passes) extras.passes->commit();
    record.timing.encode_s += closing.seconds();
    record.timing.total_s = total.seconds();
    report::write_text(report::output_path(options.out, ".json"), record.json().dump(2) + "\n");
    frame_table.commit();
    monitor.report(1, "done");
    return record;
}

}  // namespace risorius::animate
