// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/stimulus_set.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/sha256.h"
#include "risorius/core/version.h"
#include "risorius/plot/write_chart.h"
#include "risorius/report/html_writer.h"
#include "risorius/stimuli/detail/aois.h"
#include "risorius/stimuli/detail/catalogue.h"
#include "risorius/stimuli/detail/experiment_files.h"
#include "risorius/stimuli/detail/luminance_match.h"
#include "risorius/stimuli/detail/methods.h"
#include "risorius/stimuli/detail/norms.h"
#include "risorius/stimuli/detail/own_files.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

/// README of the data set.
std::string read_me(const BatchPlan& plan) {
    return "# " + plan.name + "\n\nStimuli: " + std::to_string(plan.clips.size()) +
           " clips of synthetic faces. They were simulated and rendered by Risorius " +
           std::string(kVersion) +
           " from the design code/design.json; no person is shown.\n\n"
           "- stimuli/stimuli.tsv lists the clips with their values, and with the times at which\n"
           "  movement is seen; stimuli/stimuli.json says what each column is.\n"
           "- Beside each clip there is a table with a row for each frame, and how it was made.\n"
           "- methods.md is a paragraph for the paper.\n"
           "- triggers.tsv lists the codes that the programs in experiment/ send.\n"
           "- SHA256SUMS has the checksums of all files.\n";
}

Json dataset_description(const BatchPlan& plan) {
    Json out = json_object(
        {{"Name", plan.name},
         {"BIDSVersion", "1.10.0"},
         {"HEDVersion", "8.3.0"},  // the newest that the validators have with them
         {"DatasetType", "derivative"},
         {"License", plan.dataset.license},
         {"Authors", plan.dataset.authors},
         {"GeneratedBy",
          Json::array({json_object(
              {{"Name", "Risorius"},
               {"Version", kVersion},
               {"Description", "Simulated and rendered: every face is synthetic"}})})}});
    return out;
}

/// Files that BIDS does not know.
constexpr const char* kBidsIgnore =
    "SHA256SUMS\nindex.html\nmethods.md\ntriggers.tsv\ncodes.tsv\nsample.tsv\nsample.json\ncode/"
    "\nexperiment/"
    "\nluminance/\noverview/"
    "\naois/\n"
    "norms/\nintermediate/\n*.new\n.risorius-*\n";
/// The annotations of BEP044.
constexpr const char* kAnnotations =
    "annot_id\tdescription\nannot-frames\tA row for each frame as it is shown: drive of the face, "
    "landmarks and luminance\n";
constexpr const char* kAoiAnnotation =
    "annot-aois\tA row for each frame and area of interest: its polygon in the picture\n";

/// The pictures of some clips. `from_here`: the way from the page to the folder of the set.
void write_figures(const std::vector<Json>& records, const std::vector<ClipPlan>& clips,
                   std::size_t first, std::size_t end, const std::string& from_here,
                   const fs::path& folder, report::HtmlWriter& html) {
    const bool pictures = clips.front().clips.pictures();
    std::string set;
    for (std::size_t i = first; i < end; ++i) {
        const Json& one = records[i];
        if (one.at("set").get<std::string>() != set) {
            set = one.at("set").get<std::string>();
            html.element("h2", set);
        }
        html.open("figure");
        const ClipFiles files = clip_files(clips[i]);
        html.open("a", {{"href", from_here + files.video.generic_string()},
                        {"style", "position: relative; display: inline-block"}});
        html.single("img",
                    {{"src", from_here + files.strip.generic_string()},
                     {"loading", "lazy"},
                     {"alt", (pictures ? "" : "Five frames of ") + clips[i].condition.clip}});
        if (clips[i].has_aois()) draw_aois(text_of_file(folder / files.aois), clips[i], html);
        html.close();
        std::string said = clips[i].condition.clip + ": ";
        for (const auto& [key, value] : one.at("values").items())
            if (key != "set") said += key + " " + catalogue_cell(value) + ", ";
        said += pictures ? "a picture"
                         : std::to_string(one.at("frames").get<int>()) + " frames at " +
                               catalogue_cell(one.at("fps")) + " fps";
        html.element("figcaption", said);
        html.close();
    }
}

/// Writes the page of a set, and for a large one a page for each folder of clips.
void write_overview(const BatchPlan& plan, const std::vector<Json>& records, const fs::path& folder,
                    const WriteFile& write) {
    const std::vector<ClipPlan>& clips = plan.clips;
    const bool pictures = clips.front().clips.pictures();
    report::HtmlWriter html;
    html.element("h1", plan.name);
    html.element("p",
                 std::to_string(records.size()) + (pictures ? " pictures" : " clips") +
                     ". Faces are synthetic. Values, frames and times: "
                     "stimuli/stimuli.tsv; triggers: triggers.tsv; ground truth of every frame "
                     "beside each clip.");
    if (clips.front().luminance) {
        html.element("h2", "Luminance");
        html.element("p", luminance_text(records));
        for (const char* chart : {"luminance/mean.svg", "luminance/sd.svg"})
            html.single("img", {{"src", chart}, {"alt", "Every clip before and after"}});
    }
    if (clips.front().folder.empty()) {
        write_figures(records, clips, 0, clips.size(), "", folder, html);
        write("index.html", report::html_page(plan.name, html));
        return;
    }
    for (std::size_t first = 0; first < clips.size(); first += kClipsPerFolder) {
        const std::size_t end = std::min(first + kClipsPerFolder, clips.size());
        const std::string page = "overview/" + clips[first].folder + "index.html",
                          title =
                              clips[first].condition.clip + " to " + clips[end - 1].condition.clip;
        html.open("p").element("a", title, {{"href", page}}).close();
        report::HtmlWriter figures;
        figures.element("h1", plan.name);
        figures.open("p").element("a", "All clips", {{"href", "../../index.html"}}).close();
        write_figures(records, clips, first, end, "../../", folder, figures);
        write(page, report::html_page(plan.name + ", " + title, figures));
    }
    write("index.html", report::html_page(plan.name, html));
}

/// Removes the files that `batch` has written for an earlier design and that this set does not contain. Other files stay.
void remove_former_files(const fs::path& folder, const std::set<fs::path>& kept,
                         OutputSet& outputs) {
    for (const fs::path& file : own_files(folder))
        if (kept.count(file) == 0) outputs.removal(folder / file);
}

/// Removes the folders of a set that have become empty.
void remove_empty_folders(const fs::path& folder) {
    std::error_code ignored;
    for (const char* below : {"code/scripts", "overview", "luminance", "experiment", "norms",
                              "intermediate", "takes", "stimuli", "aois"}) {
        if (!fs::is_directory(fs::symlink_status(folder / below, ignored))) continue;
        std::vector<fs::path> inside;
        for (const auto& entry : fs::directory_iterator(folder / below, ignored))
            if (is_folder_of_clips(entry.path().filename().string())) inside.push_back(entry);
        inside.push_back(folder / below);
        // Fails for one that is not empty, and for a link, as intended.
        for (const fs::path& one : inside)
            if (!fs::is_symlink(fs::symlink_status(one, ignored))) fs::remove(one, ignored);
    }
}

/// Whether somebody has changed a file of the set, or put another one there.
bool is_changed(const fs::path& folder, const fs::path& name, const std::set<fs::path>& own,
                const std::string& text) {
    const ReadingFormerOutput former;
    std::error_code none;
    return fs::is_regular_file(folder / name, none) && own.count(name) == 0 &&
           text_of_file(folder / name) != text;
}

/// The norms of the set, from the ratings that are given or that the set has already.
std::optional<Norms> write_norms(const BatchPlan& plan, const BatchOptions& options,
                                 const WriteFile& write) {
    const fs::path kept = "norms/ratings.csv";
    std::error_code none;
    if (options.norms.empty() && !fs::is_regular_file(options.out / kept, none)) return {};
    const ReadingFormerOutput former;
    const fs::path file = options.norms.empty() ? options.out / kept : options.norms;
    Norms norms = norms_of(read_ratings(file, clip_names(plan)), right_answers(plan));
    write(kept, text_of_file(file));
    write("norms/norms.json", json_text(norms.json(), 2) + "\n");
    write("norms/confusion.tsv", norms.confusion_table());
    if (!norms.catches.empty()) write("norms/catch.tsv", norms.catch_table());
    return norms;
}

}  // namespace

std::vector<std::string> write_set(const BatchPlan& plan, const BatchOptions& options,
                                   const ProgressMonitor& monitor) {
    const fs::path &design = options.design, &folder = options.out;
    std::set<fs::path> files;
    std::vector<std::string> changed;
    std::vector<Json> records;
    for (const ClipPlan& clip : plan.clips) {
        const ClipFiles its = clip_files(clip);
        files.insert(its.sidecar);
        for (const fs::path& file : its.listed()) files.insert(file);
        records.push_back(clip_record(clip, folder));
    }
    OutputSet outputs(folder);
    std::map<fs::path, fs::path> fresh;
    const std::set<fs::path> own = own_files(folder);
    const WriteFile write = [&](const fs::path& name, const std::string& text) {
        fs::path to = name;
        if (!options.replace && is_changed(folder, name, own, text)) {
            changed.push_back(name.generic_string());
            to += ".new";
        }
        fresh[to] = outputs.file(folder / to);
        write_file(fresh[to], text);
        files.insert(to);
    };
    write("dataset_description.json", json_text(dataset_description(plan), 2) + "\n");
    write("README", read_me(plan));
    write("methods.md", methods_text(plan, records));
    write(".bidsignore", kBidsIgnore);
    const std::optional<Norms> norms = write_norms(plan, options, write);
    const Catalogue catalogue = catalogue_of(plan, records, norms);
    write("stimuli/stimuli.tsv", catalogue.table);
    write("stimuli/stimuli.json", json_text(catalogue.columns, 2) + "\n");
    write("stimuli/annotations.tsv", plan.clips.front().clips.aois.empty()
                                         ? kAnnotations
                                         : std::string(kAnnotations) + kAoiAnnotation);
    write("triggers.tsv", triggers(records, plan.codes));
    if (!plan.codes.table.empty()) write("codes.tsv", plan.codes.table);
    if (!plan.samples.empty()) {
        const Catalogue sample = sample_of(plan, records);
        write("sample.tsv", sample.table);
        write("sample.json", json_text(sample.columns, 2) + "\n");
    }
    // It may be the design that is read.
    if (std::error_code none; fs::equivalent(design, folder / "code/design.json", none))
        files.insert("code/design.json");
    else
        write("code/design.json", text_of_file(design));
    write_overview(plan, records, folder, write);
    if (plan.match.luminance)
        for (const plot::Chart& chart : write_luminance_report(plan, records, write)) {
            // gnuplot writes where the first of its files is to be.
            const fs::path below = outputs.file(folder / kLuminanceFolder / (chart.name + ".svg"));
            for (const std::string& name : plot::write_chart(chart, below.parent_path())) {
                const fs::path file = fs::path(kLuminanceFolder) / name;
                fresh[file] = below.parent_path() / name;
                if (fresh[file] != below) outputs.file(folder / file);
                files.insert(file);
            }
        }
    if (plan.experiment) write_experiment(plan, records, write);
    for (const std::string& name : changed) files.insert(name);  // they stay
    remove_former_files(folder, files, outputs);
    for (const std::string& name : changed) files.erase(name);
    const ReadingFormerOutput former;
    std::string sums;
    for (const fs::path& file : files) {
        const auto written = fresh.find(file);
        sums += sha256_of_file(written == fresh.end() ? folder / file : written->second) + "  " +
                file.generic_string() + "\n";
    }
    write_file(outputs.file(folder / "SHA256SUMS"), sums);
    monitor.throw_if_stopped();
    outputs.commit();
    remove_empty_folders(folder);
    return changed;
}

}  // namespace risorius::stimuli
