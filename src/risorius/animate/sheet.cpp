// SPDX-License-Identifier: MIT
#include "risorius/animate/sheet.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/output_set.h"
#include "risorius/core/sha256.h"
#include "risorius/media/image_file.h"
#include "risorius/report/contact_sheet.h"
#include "risorius/report/output_paths.h"

namespace risorius::animate {

namespace {

constexpr int kMaxPictures = 400;

void check_sheet(const SheetOptions& options) {
    if (options.out.extension() != ".png")
        throw Error(options.out.string(), "an ending of .png",
                    "\"" + options.out.extension().string() + "\"");
    if (options.times_s.empty())
        throw Error(option_name("times_s"), "at least one time in seconds", "none");
    const std::size_t columns =
        options.times_s.size() * std::max<std::size_t>(1, options.cameras.size());
    if (!options.captions.empty() && options.captions.size() != columns)
        throw Error(option_name("captions"),
                    "a caption for each of " + std::to_string(columns) + " columns",
                    std::to_string(options.captions.size()));
    const std::size_t pictures =
        options.scripts.size() * columns * std::max<std::size_t>(1, options.rigs.size());
    if (pictures > kMaxPictures)
        throw Error(option_name("times_s"),
                    "at most " + std::to_string(kMaxPictures) + " pictures on a sheet",
                    std::to_string(pictures));
    for (const std::string& camera : options.cameras)
        index_of_name(option_name("cameras"), camera, render::camera_names());
    report::check_record(report::output_path(options.out, ".json"));
}

/// "samples/smile/script.json" -> "smile", "mine/wink.json" -> "wink": the name of the folder if the file has the usual name.
std::string short_name(const std::filesystem::path& file, const char* usual) {
    const std::string stem = file.stem().string();
    const std::string folder = std::filesystem::absolute(file).parent_path().filename().string();
    return stem == usual ? folder : stem;
}

/// The picture scaled down to fit a cell of the sheet, on white.
Image fitted(const Image& picture, int width_px, int height_px) {
    const double scale = std::min({static_cast<double>(width_px) / picture.width_px,
                                   static_cast<double>(height_px) / picture.height_px, 1.0});
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(scale * side)); };
    const Image small =
        report::shrunk(picture, scaled(picture.width_px), scaled(picture.height_px));
    Image out(width_px, height_px);
    std::fill(out.rgba.begin(), out.rgba.end(), std::uint8_t{255});
    const int left = (width_px - small.width_px) / 2, top = (height_px - small.height_px) / 2;
    for (int y = 0; y < small.height_px; ++y)
        std::copy_n(small.pixel(0, y), 4 * small.width_px, out.pixel(left, top + y));
    return out;
}

/// Rows of other pictures, with as many per row as the sheet has columns.
std::vector<report::ContactRow> rows_beside(const std::vector<std::filesystem::path>& files,
                                            std::size_t columns, int width_px, int height_px) {
    std::vector<report::ContactRow> rows;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (i % columns == 0) rows.emplace_back();
        report::ContactRow& row = rows.back();
        row.name = "beside";
        row.numbers += (row.numbers.empty() ? "" : ", ") + files[i].stem().string();
        row.pictures.push_back(fitted(media::read_png(files[i]), width_px, height_px));
    }
    Image blank(width_px, height_px);
    std::fill(blank.rgba.begin(), blank.rgba.end(), std::uint8_t{255});
    while (!rows.empty() && rows.back().pictures.size() < columns)
        rows.back().pictures.push_back(blank);
    return rows;
}

/// One job per script and rig. All have the size of the first.
std::vector<RenderJob> plan_jobs(const SheetOptions& options,
                                 const std::function<bool()>& stopped) {
    RenderRequest request = options.view;
    request.out = options.out;
    request.times_s = options.times_s;
    std::sort(request.times_s.begin(), request.times_s.end());
    RenderInputs inputs(stopped);
    std::vector<RenderJob> jobs;
    const auto plan = [&] {
        jobs.push_back(plan_render_job(request, inputs));
        request.size = PictureSize{jobs[0].view.width_px, jobs[0].view.height_px};
    };
    for (const std::filesystem::path& script : options.scripts) {
        request.script = script;
        if (options.rigs.empty()) plan();
        for (const std::filesystem::path& rig : options.rigs) {
            request.rig = rig;
            plan();
        }
    }
    return jobs;
}

std::vector<std::string> column_names(const SheetOptions& options,
                                      const std::vector<std::string>& cameras) {
    if (!options.captions.empty()) return options.captions;
    std::vector<std::string> names;
    for (const std::string& camera : cameras)
        for (const double time_s : options.times_s)
            names.push_back(options.cameras.empty() ? format_number(time_s) + " s"
                            : options.times_s.size() > 1
                                ? camera + ", " + format_number(time_s) + " s"
                                : camera);
    return names;
}

}  // namespace

Json make_sheet(const SheetOptions& options, const ProgressMonitor& monitor) {
    check_sheet(options);
    std::vector<RenderJob> jobs = plan_jobs(options, monitor.stopped);
    const render::ViewOptions& first = jobs.front().view;
    std::vector<std::string> cameras = options.cameras;
    if (cameras.empty()) cameras = {first.camera};
    report::ContactSheet sheet;
    sheet.columns = column_names(options, cameras);
    const std::vector<report::ContactRow> others =
        rows_beside(options.beside, sheet.columns.size(), first.width_px, first.height_px);
    OutputSet outputs(folder_of_output(options.out));
    const std::filesystem::path out = outputs.file(options.out),
                                record_text =
                                    outputs.file(report::output_path(options.out, ".json"));

    Json record =
        json_object({{"format", "risorius-sheet"}, {"version", 1}, {"runs", Json::array()}});
    RenderSession session;
    double begun = 0;
    const double all = static_cast<double>(jobs.size() * cameras.size());
    for (RenderJob& job : jobs) {
        report::ContactRow row;
        row.name = short_name(job.script_file.path, "script");
        for (const std::string& camera : cameras) {
            if (!options.cameras.empty()) job.view.camera = camera;
            std::vector<Image> pictures;
            ProgressMonitor part = monitor;
            if (monitor.progress)
                part.progress = [&](double fraction, const std::string& what) {
                    monitor.progress((begun + fraction) / all, what);
                };
            const RunRecord run =
                run_render_job(
                    job, session, [&](Image image) { pictures.push_back(std::move(image)); }, part)
                    .record;
            record["runs"].push_back(run.json());
            row.numbers = short_name(run.rig.path, "rig");
            for (const double time_s : options.times_s) {
                const auto at = std::lower_bound(job.times_s.begin(), job.times_s.end(), time_s);
                row.pictures.push_back(
                    pictures[static_cast<std::size_t>(at - job.times_s.begin())]);
            }
            begun += 1;
        }
        sheet.rows.push_back(std::move(row));
    }
    sheet.rows.insert(sheet.rows.end(), others.begin(), others.end());
    media::write_png(report::draw_contact_sheet(sheet), out);
    record["out_sha256"] = sha256_of_file(out);
    write_file(record_text, json_text(record, 2) + "\n");
    monitor.throw_if_stopped();
    outputs.commit();
    return record;
}

}  // namespace risorius::animate
