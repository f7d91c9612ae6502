// SPDX-License-Identifier: MIT
#include "risorius/animate/animate.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/core/sha256.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_writer.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/output_paths.h"
#include "risorius/report/stopwatch.h"
#include "risorius/talk/script_labels.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kSound{"a file with sound", 1'000'000 * kMegabyte};

// The main output: a video, or a single picture for a still.
class Output {
  public:
    Output(const RenderJob& job, OutputSet& outputs)
        : out_(job.out.has_filename() ? outputs.file(job.out) : outputs.folder(job.out) / "") {
        if (!job.still) video_.emplace(out_, job.video);
    }
    void append(Image image) {
        if (video_)
            video_->append(image);
        else
            still_ = std::move(image);
    }
    /// Returns the SHA-256 of the file; empty for a folder of frames.
    std::string finish() {
        if (video_)
            video_->finish();
        else if (!still_.deep.empty())
            media::write_png16(still_, out_);
        else
            media::write_png(still_, out_);
        return out_.has_filename() ? sha256_of_file(out_) : "";
    }

  private:
    fs::path out_;
    std::optional<media::VideoWriter> video_;
    Image still_;
};

/// What the video says, as a TextGrid; empty when it says nothing, or when its time is not that of the script.
std::string labels_of(const RenderJob& job) {
    if (job.still || job.turntable || !job.times_s.empty()) return "";
    return talk::script_textgrid(job.speech.utterances, job.script.header.duration_s);
}

}  // namespace

RunRecord animate(const RenderRequest& request, const ProgressMonitor& monitor) {
    const report::Stopwatch total;
    if (request.out.extension() == ".png" && !request.still_s)
        throw Error(
            request.out.string(),
            option_name("still_s") +
                " with it, the name of a video, or of a folder of PNG frames, which ends in /",
            "\".png\" alone");
    RenderInputs inputs(monitor);
    RenderJob job = plan_render_job(request, inputs);
    const fs::path record_file = report::output_path(job.out, ".json"),
                   table_file = report::output_path(job.out, ".frames.tsv"),
                   labels_file = report::output_path(job.out, ".speech.TextGrid");
    report::check_record(record_file);
    report::check_table(table_file);
    if (request.audio) check_file(*request.audio, kSound);  // so that it is known as an input
    OutputSet outputs(folder_of_output(job.out));
    Output output(job, outputs);
    const fs::path record_text = outputs.file(record_file), table_text = outputs.file(table_file);
    const std::string labels = labels_of(job);
    const fs::path labels_text = labels.empty() ? fs::path() : outputs.file(labels_file);
    const fs::path passes = job.passes_folder;
    if (!job.passes.empty()) {
        report::check_results_folder(passes);
        job.passes_folder = outputs.folder(passes);
    }

    // One picture per frame
    RenderSession session;
    RenderResult result = run_render_job(
        job, session, [&](Image image) { output.append(std::move(image)); }, monitor);

    // All files appear together, or none.
    write_file(table_text, result.table);
    if (!labels.empty()) write_file(labels_text, labels);
    const report::Stopwatch closing;
    RunRecord& record = result.record;
    record.out_sha256 = output.finish();
    if (result.passes) result.passes->commit();
    record.timing.encode_s += closing.seconds();
    record.timing.total_s = total.seconds();
    write_file(record_text, json_text(record.json(), 2) + "\n");
    monitor.report(1, "done");
    if (!job.passes.empty()) report::check_results_folder(passes);
    outputs.commit();
    return record;
}

}  // namespace risorius::animate
