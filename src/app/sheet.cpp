#include "app/sheet.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/beside.h"
#include "app/contact_sheet.h"
#include "app/film.h"
#include "app/staged_file.h"
#include "core/error.h"
#include "media/image_file.h"

namespace risorius::app {

namespace {

constexpr int kMostPictures = 400;

void check_sheet(const SheetOptions& options) {
    if (options.out.extension() != ".png")
        throw Error(options.out.string(), "an ending of .png",
                    "\"" + options.out.extension().string() + "\"");
    if (options.times_s.empty()) throw Error("--times", "at least one time in seconds", "none");
    const std::size_t pictures = options.scripts.size() * options.times_s.size() *
                                 std::max<std::size_t>(1, options.rigs.size());
    if (pictures > kMostPictures)
        throw Error("--times", "at most " + std::to_string(kMostPictures) + " pictures on a sheet",
                    std::to_string(pictures));
    check_record(beside(options.out, ".json"));
}

/// "samples/smile/script.json" -> "smile", "mine/wink.json" -> "wink": the folder where all files have one name.
std::string short_name(const std::filesystem::path& file, const char* usual) {
    const std::string stem = file.stem().string();
    const std::string folder = std::filesystem::absolute(file).parent_path().filename().string();
    return stem == usual ? folder : stem;
}

std::vector<AnimateOptions> runs_of(const SheetOptions& options) {
    std::vector<AnimateOptions> runs;
    for (const std::filesystem::path& script : options.scripts) {
        AnimateOptions run = options.view;
        run.script = script;
        run.out = options.out;
        run.times_s = options.times_s;
        std::sort(run.times_s.begin(), run.times_s.end());
        if (options.rigs.empty()) runs.push_back(run);
        for (const std::filesystem::path& rig : options.rigs) {
            run.rig = rig;
            runs.push_back(run);
        }
    }
    return runs;
}

}  // namespace

Json make_sheet(const SheetOptions& options, const Watch& watch) {
    check_sheet(options);
    const std::vector<AnimateOptions> runs = runs_of(options);
    std::vector<Shot> shots;
    for (const AnimateOptions& run : runs) shots.push_back(plan_shot(run));
    for (Shot& shot : shots) {  // one size on a sheet
        shot.view.width_px = shots.front().view.width_px;
        shot.view.height_px = shots.front().view.height_px;
    }

    ContactSheet sheet;
    for (const double time_s : options.times_s)
        sheet.columns.push_back(format_number(time_s) + " s");
    Json record{{"format", "risorius-sheet"}, {"version", 1}, {"runs", Json::array()}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::vector<Image> pictures;
        FilmExtras extras;
        Watch part = watch;
        const auto begun = static_cast<double>(i), all = static_cast<double>(runs.size());
        if (watch.progress)
            part.progress = [&](double share, const std::string& what) {
                watch.progress((begun + share) / all, what);
            };
        const RunRecord run = film(
            runs[i], shots[i], [&](Image image) { pictures.push_back(std::move(image)); }, extras,
            part);
        record["runs"].push_back(run.json());
        ContactRow row;
        row.name = short_name(runs[i].script, "script");
        row.numbers = short_name(run.rig.path, "rig");
        for (const double time_s : options.times_s) {
            const auto at =
                std::lower_bound(runs[i].times_s.begin(), runs[i].times_s.end(), time_s);
            row.pictures.push_back(
                pictures[static_cast<std::size_t>(at - runs[i].times_s.begin())]);
        }
        sheet.rows.push_back(std::move(row));
    }
    StagedFile staged(beside(options.out, ".json"), record.dump(2) + "\n");
    media::write_png(draw_contact_sheet(sheet), options.out);
    staged.commit();
    return record;
}

}  // namespace risorius::app
