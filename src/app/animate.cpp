#include "app/animate.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "app/beside.h"
#include "app/film.h"
#include "app/shot.h"
#include "app/staged_file.h"
#include "app/stopwatch.h"
#include "core/error.h"
#include "media/image_file.h"
#include "media/video_writer.h"

namespace risorius::app {

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

RunRecord animate(const AnimateOptions& options, const Watch& watch) {
    const Stopwatch total;
    if (options.out.extension() == ".png" && !options.still_s)
        throw Error(
            options.out.string(),
            "--still TIME with it, the name of a video, or of a folder of PNG frames, which "
            "ends in /",
            "\".png\" alone");
    const Shot shot = plan_shot(options);
    check_record(beside(options.out, ".json"));
    check_table(beside(options.out, ".frames.tsv"));
    Output output(options.out, shot, options.still_s.has_value());

    // One picture per frame
    FilmExtras extras;
    extras.passes_folder = beside(options.out, ".passes");
    RunRecord record = film(
        options, shot, [&](Image image) { output.append(std::move(image)); }, extras, watch);

    // Leave everything or nothing
    StagedFile frame_table(beside(options.out, ".frames.tsv"), extras.table);
    const Stopwatch closing;
    output.finish();
    if (extras.passes) extras.passes->commit();
    record.timing.encode_s += closing.seconds();
    record.timing.total_s = total.seconds();
    write_text(beside(options.out, ".json"), record.json().dump(2) + "\n");
    frame_table.commit();
    watch.tell(1, "done");
    return record;
}

}  // namespace risorius::app
