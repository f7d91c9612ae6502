// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/stimulus_set.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/input_log.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/version.h"
#include "risorius/media/sha256.h"
#include "risorius/plot/write_chart.h"
#include "risorius/report/html_writer.h"
#include "risorius/stimuli/detail/experiment_files.h"
#include "risorius/stimuli/detail/luminance_match.h"
#include "risorius/stimuli/detail/own_files.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMissing = "n/a";  // the marker of BIDS for missing values

std::string cell(const Json& value) {
    if (value.is_null()) return kMissing;
    std::string text = value.is_string()   ? value.get<std::string>()
                       : value.is_number() ? format_number(value.get<double>())
                                           : json_text(value);
    for (char& c : text)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return text.empty() ? kMissing : text;
}

/// The names of values of all clips, in the order of their first occurrence.
std::vector<std::string> value_names(const std::vector<Json>& records) {
    std::vector<std::string> out;
    for (const Json& record : records)
        for (const auto& [name, value] : record.at("values").items())
            if (name != "set" && std::find(out.begin(), out.end(), name) == out.end())
                out.push_back(name);
    return out;
}

bool has_sound(const std::vector<ClipPlan>& clips) {
    return std::any_of(clips.begin(), clips.end(),
                       [](const ClipPlan& clip) { return clip.sound.has_value(); });
}

std::string catalogue(const std::vector<Json>& records, const std::vector<ClipPlan>& clips) {
    const std::vector<std::string> names = value_names(records);
    std::string out =
        "stim_id\tstim_file\tset\tcontrol\tcontrol_of\tframes\tfps\tduration_s\t"
        "movement_onset_s\tapex_s\tpictures_sha256";
    const bool heard = has_sound(clips);
    if (heard) out += "\tloudness_lufs\ttrue_peak_dbtp";
    for (const std::string& name : names) out += "\t" + name;
    out += "\n";
    for (std::size_t i = 0; i < records.size(); ++i) {
        const Json& one = records[i];
        const double fps = one.at("fps").get<double>();
        const std::string control = one.at("control").get<std::string>();
        out += one.at("stim_id").get<std::string>() + "\t" +
               clip_files(clips[i]).video.filename().string() + "\t" + cell(one.at("set")) + "\t" +
               (control.empty() ? kMissing : control) + "\t" +
               (control.empty() ? kMissing : one.at("of").get<std::string>()) + "\t" +
               cell(one.at("frames")) + "\t" + cell(one.at("fps")) + "\t" +
               cell(one.at("duration_s")) + "\t" +
               format_number(one.at("movement_onset_frame").get<double>() / fps) + "\t" +
               format_number(one.at("apex_frame").get<double>() / fps) + "\t" +
               one.at("pictures_sha256").get<std::string>();
        for (const char* key : {"loudness_lufs", "true_peak_dbtp"})
            if (heard)
                out += "\t" + (one.contains("audio") ? cell(one.at("audio").at(key)) : kMissing);
        for (const std::string& name : names) {
            const auto value = one.at("values").find(name);
            out += "\t" + (value == one.at("values").end() ? kMissing : cell(*value));
        }
        out += "\n";
    }
    return out;
}

Json catalogue_columns(const std::vector<Json>& records, const std::vector<ClipPlan>& clips) {
    Json out{
        {"stim_id", {{"Description", "Name of the clip"}}},
        {"stim_file", {{"Description", "The video, in this folder"}}},
        {"set", {{"Description", "Set of conditions of the design"}}},
        {"control", {{"Description", "What differs from the clip it is a control of"}}},
        {"control_of", {{"Description", "stim_id of that clip"}}},
        {"frames", {{"Description", "Number of frames"}}},
        {"fps", {{"Description", "Frames per second, constant"}, {"Units", "Hz"}}},
        {"duration_s", {{"Description", "Frames over frame rate"}, {"Units", "s"}}},
        {"movement_onset_s",
         {{"Description",
           "Start of the first frame in which a landmark of the face has moved by 0.3 mm, or by "
           "5 % of the farthest way of any landmark if that is less"},
          {"Units", "s"}}},
        {"apex_s",
         {{"Description",
           "Start of the frame in which a landmark is farthest from where it was in the first"},
          {"Units", "s"}}},
        {"pictures_sha256",
         {{"Description", "Of the RGBA bytes of all frames before they were encoded"}}}};
    if (has_sound(clips)) {
        out["loudness_lufs"] = {
            {"Description", "Integrated loudness of the clip's sound by EBU R 128"},
            {"Units", "LUFS"}};
        out["true_peak_dbtp"] = {{"Description", "Highest peak of the clip's sound by EBU R 128"},
                                 {"Units", "dBTP"}};
    }
    for (const std::string& name : value_names(records))
        out[name] = {{"Description", "Parameter of the design, see code/design.json"}};
    return out;
}

/// triggers.tsv, with the codes 1 clip_on, 2 movement_onset, 3 apex and 4 clip_off.
std::string triggers(const std::vector<Json>& records) {
    std::string out = "stim_id\tevent\tcode\tframe\ttime_s\n";
    for (const Json& one : records) {
        const double fps = one.at("fps").get<double>();
        const auto row = [&](const char* event, int code, int frame) {
            out += one.at("stim_id").get<std::string>() + "\t" + event + "\t" +
                   std::to_string(code) + "\t" + std::to_string(frame) + "\t" +
                   format_number(frame / fps) + "\n";
        };
        row("clip_on", 1, 0);
        row("movement_onset", 2, one.at("movement_onset_frame").get<int>());
        row("apex", 3, one.at("apex_frame").get<int>());
        row("clip_off", 4, one.at("frames").get<int>());
    }
    return out;
}

std::string overview(const std::string& name, const std::vector<Json>& records,
                     const std::vector<ClipPlan>& clips) {
    report::HtmlWriter html;
    html.element("h1", name);
    html.element("p",
                 std::to_string(records.size()) +
                     " clips. Faces are synthetic. Values, frames and times: "
                     "stimuli/stimuli.tsv; triggers: triggers.tsv; ground truth of every frame "
                     "beside each clip.");
    if (clips.front().luminance) {
        html.element("h2", "Luminance");
        html.element("p", luminance_text(records));
        for (const char* chart : {"luminance/mean.svg", "luminance/sd.svg"})
            html.single("img", {{"src", chart}, {"alt", "Every clip before and after"}});
    }
    std::string set;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const Json& one = records[i];
        if (one.at("set").get<std::string>() != set) {
            set = one.at("set").get<std::string>();
            html.element("h2", set);
        }
        html.open("figure");
        const ClipFiles files = clip_files(clips[i]);
        html.open("a", {{"href", files.video.generic_string()}});
        html.single("img", {{"src", files.strip.generic_string()},
                            {"loading", "lazy"},
                            {"alt", "Five frames of " + clips[i].condition.clip}});
        html.close();
        std::string said = clips[i].condition.clip + ": ";
        for (const auto& [key, value] : one.at("values").items())
            if (key != "set") said += key + " " + cell(value) + ", ";
        said += std::to_string(one.at("frames").get<int>()) + " frames at " + cell(one.at("fps")) +
                " fps";
        html.element("figcaption", said);
        html.close();
    }
    return report::html_page(name, html);
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
    for (const char* below : {"code/scripts", "overview", "luminance", "experiment", "intermediate",
                              "takes", "stimuli"})
        if (!fs::is_symlink(fs::symlink_status(folder / below, ignored)))
            fs::remove(folder / below, ignored);  // fails for one that is not empty, as intended
}

}  // namespace

void write_set(const BatchPlan& plan, const fs::path& design, const fs::path& folder,
               const ProgressMonitor& monitor) {
    std::set<fs::path> files;
    std::vector<Json> records;
    for (const ClipPlan& clip : plan.clips) {
        const ClipFiles its = clip_files(clip);
        files.insert(its.sidecar);
        for (const fs::path& file : its.listed()) files.insert(file);
        records.push_back(clip_record(clip, folder));
    }
    OutputSet outputs(folder);
    std::map<fs::path, fs::path> fresh;
    const WriteFile write = [&](const fs::path& name, const std::string& text) {
        fresh[name] = outputs.file(folder / name);
        write_file(fresh[name], text);
        files.insert(name);
    };
    write("dataset_description.json",
          json_text(Json{{"Name", plan.name},
                         {"BIDSVersion", "1.10.0"},
                         {"DatasetType", "derivative"},
                         {"GeneratedBy",
                          Json::array({{{"Name", "Risorius"},
                                        {"Version", kVersion},
                                        {"Description",
                                         "Simulated and rendered: every face is synthetic"}}})}},
                    2) +
              "\n");
    write("stimuli/stimuli.tsv", catalogue(records, plan.clips));
    write("stimuli/stimuli.json", json_text(catalogue_columns(records, plan.clips), 2) + "\n");
    write("triggers.tsv", triggers(records));
    // It may be the design that is read.
    if (std::error_code none; fs::equivalent(design, folder / "code/design.json", none))
        files.insert("code/design.json");
    else
        write("code/design.json", text_of_file(design));
    write("index.html", overview(plan.name, records, plan.clips));
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
    remove_former_files(folder, files, outputs);
    const ReadingFormerOutput former;
    std::string sums;
    for (const fs::path& file : files) {
        const auto written = fresh.find(file);
        sums += media::sha256_of_file(written == fresh.end() ? folder / file : written->second) +
                "  " + file.generic_string() + "\n";
    }
    write_file(outputs.file(folder / "SHA256SUMS"), sums);
    monitor.throw_if_stopped();
    outputs.commit();
    remove_empty_folders(folder);
}

}  // namespace risorius::stimuli
