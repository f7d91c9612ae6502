// SPDX-License-Identifier: MIT
#include "risorius/animate/animate.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_writer.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/output_paths.h"
#include "risorius/report/stopwatch.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

// The main output: a video, or a single picture for a still.
class Output {
  public:
    explicit Output(const RenderJob& job) : out_(job.out) {
        if (!job.still) video_.emplace(job.out, job.video);
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

RunRecord animate(const RenderRequest& request, const ProgressMonitor& monitor) {
    const report::Stopwatch total;
    if (request.out.extension() == ".png" && !request.still_s)
        throw Error(
            request.out.string(),
            option_name("still_s") +
                " with it, the name of a video, or of a folder of PNG frames, which ends in /",
            "\".png\" alone");
    const RenderJob job = plan_render_job(request);
    const fs::path record_file = report::output_path(job.out, ".json"),
                   table_file = report::output_path(job.out, ".frames.tsv");
    report::check_record(record_file);
    report::check_table(table_file);
    Output output(job);

    // One picture per frame
    RenderSession session;
    RenderResult result = run_render_job(
        job, session, [&](Image image) { output.append(std::move(image)); }, monitor);

    // All files appear together, or none.
    report::AtomicFile frame_table(table_file, result.table);
    const report::Stopwatch closing;
    output.finish();
    if (result.passes) result.passes->commit();
    RunRecord& record = result.record;
    record.timing.encode_s += closing.seconds();
    record.timing.total_s = total.seconds();
    report::write_text(record_file, record.json().dump(2) + "\n");
    frame_table.commit();
    monitor.report(1, "done");
    return record;
}

}  // namespace risorius::animate
