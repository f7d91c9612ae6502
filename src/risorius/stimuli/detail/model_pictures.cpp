// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/model_pictures.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_writer.h"
#include "risorius/report/contact_sheet.h"

namespace risorius::stimuli {

namespace {

constexpr int kSide_px = 384, kStripSide_px = 192, kColumns = 7;

}  // namespace

void ModelPictures::write(const std::vector<NamedScript>& scripts, std::size_t film,
                          const std::filesystem::path& stem) {
    report::ContactSheet sheet;
    for (std::size_t s = 0; s < scripts.size(); ++s) {
        animate::RenderRequest request;
        request.script = stem.filename().string() + " " + scripts[s].name;
        request.script_in_memory =
            JsonCursor::from_json(scripts[s].script, request.script.string());
        request.out = "none.mp4";
        request.size = {kSide_px, kSide_px};
        const animate::RenderJob job = animate::plan_render_job(request, inputs_);
        std::optional<media::VideoWriter> video;
        if (s == film) video.emplace(outputs_.file(stem.string() + ".mp4"), job.video);
        report::ContactRow row{scripts[s].name, "", {}};
        int frame = 0;
        animate::run_render_job(
            job, session_,
            [&](Image image) {
                if (video) video->append(image);
                const auto at = static_cast<double>(row.pictures.size());
                if (frame++ >= std::lround(at * (job.frames - 1) / (kColumns - 1)))
                    row.pictures.push_back(report::shrunk(image, kStripSide_px, kStripSide_px));
            },
            monitor_);
        if (video) video->finish();
        if (s == 0)
            for (int column = 0; column < kColumns; ++column)
                sheet.columns.push_back(
                    format_number(
                        std::round(100.0 *
                                   std::lround(column * (job.frames - 1.0) / (kColumns - 1)) /
                                   job.fps) /
                        100) +
                    " s");
        sheet.rows.push_back(std::move(row));
    }
    media::write_png(report::draw_contact_sheet(sheet), outputs_.file(stem.string() + ".png"));
}

}  // namespace risorius::stimuli
