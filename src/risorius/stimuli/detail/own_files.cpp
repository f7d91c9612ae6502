// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/own_files.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_text.h"
#include "risorius/core/read_file.h"
#include "risorius/core/sha256.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kSums{"a list of checksums", 100 * kMegabyte};
constexpr FileKind kShellScript{"a script of the shell", kMegabyte};

/// The files of a set beside those of its clips, see stimulus_set.h and experiment_files.h.
constexpr std::array kFilesOfSet{"dataset_description.json",
                                 "README",
                                 "methods.md",
                                 ".bidsignore",
                                 "stimuli/annotations.tsv",
                                 "stimuli/stimuli.tsv",
                                 "stimuli/stimuli.json",
                                 "triggers.tsv",
                                 "codes.tsv",
                                 "sample.tsv",
                                 "sample.json",
                                 "code/design.json",
                                 "index.html",
                                 "luminance/luminance.tsv",
                                 "luminance/luminance.json",
                                 "luminance/spectrum.tsv",
                                 "luminance/mean.svg",
                                 "luminance/mean.png",
                                 "luminance/mean.gp",
                                 "luminance/mean.data.csv",
                                 "luminance/sd.svg",
                                 "luminance/sd.png",
                                 "luminance/sd.gp",
                                 "luminance/sd.data.csv",
                                 "norms/ratings.csv",
                                 "norms/norms.json",
                                 "norms/confusion.tsv",
                                 "norms/catch.tsv",
                                 "experiment/conditions.csv",
                                 "experiment/settings.json",
                                 "experiment/experiment.py",
                                 "experiment/index.html",
                                 "experiment/rating.html"};

/// Whether it is a regular file that is reached without links.
bool is_plain_file(const fs::path& folder, const fs::path& relative) {
    fs::path path = folder;
    std::error_code ignored;
    for (const fs::path& part : relative) {
        if (part == "." || part == "..") return false;
        path /= part;
        if (fs::is_symlink(fs::symlink_status(path, ignored))) return false;
    }
    return fs::is_regular_file(fs::symlink_status(path, ignored));
}

bool has_bytes(const fs::path& folder, const fs::path& relative, const std::string& sha256) {
    return is_plain_file(folder, relative) && sha256_of_file(folder / relative) == sha256;
}

/// The files in a folder below that is no link, and in its folders of clips, as paths from there, sorted.
std::vector<fs::path> files_in(const fs::path& folder, const fs::path& below) {
    std::vector<fs::path> files;
    std::error_code ignored;
    if (!fs::is_directory(fs::symlink_status(folder / below, ignored))) return files;
    for (const auto& entry : fs::directory_iterator(folder / below, ignored)) {
        const std::string name = entry.path().filename().string();
        const bool of_clips = is_folder_of_clips(name) && !below.has_parent_path();
        if (!of_clips || !fs::is_directory(entry.symlink_status(ignored))) {
            files.push_back(name);
            continue;
        }
        for (const fs::path& file : files_in(folder, below / name)) files.push_back(name / file);
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Whether a file below "stimuli" has the name of a sidecar.
bool is_named_as_sidecar(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("stim-") && name.ends_with(".json");
}

/// The object in a JSON file; none when it holds anything else.
std::optional<Json> object_of(const fs::path& folder, const fs::path& relative) {
    if (!is_plain_file(folder, relative)) return {};
    try {
        Json json = JsonCursor::read_file(folder / relative).json();
        if (json.is_object()) return json;
    } catch (const Error&) {
        return {};  // a file of someone else
    }
    return {};
}

std::string text_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The name of the clip that a sidecar belongs to; empty for any other file.
std::string clip_of(const Json& record, const std::string& file_name) {
    const std::string clip = text_at(record, "stim_id");
    const bool named = file_name == "stim-" + clip + "_video.json" ||
                       file_name == "stim-" + clip + "_audiovideo.json" ||
                       file_name == "stim-" + clip + "_image.json";
    return text_at(record, "format") == "risorius-clip" && named ? clip : "";
}

/// Whether a clip can have this file. `below`: "", or the folder of its clips, "b012/".
bool belongs_to(const std::string& clip, const std::string& below, const std::string& file) {
    const std::string stem = "stimuli/" + below + "stim-" + clip + "_", name = below + clip;
    return file == "overview/" + name + ".png" || file == "code/scripts/" + name + ".json" ||
           file == "code/scripts/" + name + "_lower.json" ||
           file == "aois/" + name + "_tobii.json" || file == "aois/" + name + ".ias" ||
           (file.starts_with(stem) && file.find('/', stem.size()) == std::string::npos);
}

void add_clips(const fs::path& folder, std::set<fs::path>& files) {
    for (const fs::path& file : files_in(folder, "stimuli")) {
        if (!is_named_as_sidecar(file)) continue;
        const fs::path sidecar = "stimuli" / file;
        const std::string below =
            file.has_parent_path() ? file.parent_path().generic_string() + "/" : "";
        const std::optional<Json> record = object_of(folder, sidecar);
        const std::string clip = record ? clip_of(*record, file.filename().string()) : "";
        if (clip.empty() || !record->contains("files") || !record->at("files").is_object())
            continue;
        files.insert(sidecar);
        for (const auto& [its, sha256] : record->at("files").items())
            if (sha256.is_string() && belongs_to(clip, below, its) &&
                has_bytes(folder, its, sha256.get<std::string>()))
                files.insert(its);
    }
}

void add_renders(const fs::path& folder, std::set<fs::path>& files) {
    for (const char* below : kIntermediateFolders)
        for (const fs::path& name : files_in(folder, below)) {
            if (name.extension() != ".json") continue;
            const fs::path file = fs::path(below) / name;
            const std::optional<Json> record = object_of(folder, file);
            if (!record || text_at(*record, "film_sha256").empty()) continue;
            const fs::path video = fs::path(file).replace_extension(".mkv"),
                           table = fs::path(file).replace_extension(".tsv");
            if (!has_bytes(folder, video, text_at(*record, "video_sha256")) ||
                !has_bytes(folder, table, text_at(*record, "table_sha256")))
                continue;
            files.insert({file, video, table});
        }
}

/// Whether it is a page of the overview of a large set, "overview/b012/index.html".
bool is_page_of_clips(const fs::path& file) {
    return file.filename() == "index.html" &&
           is_folder_of_clips(file.parent_path().filename().string()) &&
           file.parent_path().parent_path() == "overview";
}

void add_listed(const fs::path& folder, std::set<fs::path>& files) {
    if (!is_plain_file(folder, "SHA256SUMS")) return;
    std::istringstream sums(read_file(folder / "SHA256SUMS", kSums));
    for (std::string line; std::getline(sums, line);) {
        const std::size_t gap = line.find("  ");
        if (gap == std::string::npos) continue;
        const std::string file = line.substr(gap + 2);
        const std::string beside = file.ends_with(".new") ? file.substr(0, file.size() - 4) : file;
        if ((std::find(kFilesOfSet.begin(), kFilesOfSet.end(), beside) != kFilesOfSet.end() ||
             is_page_of_clips(beside)) &&
            has_bytes(folder, file, line.substr(0, gap)))
            files.insert(file);
    }
}

/// The name of the design that `batch` has begun the folder for, empty where it is not known; none when it has not begun it.
using BegunFor = std::optional<std::string>;

/// By the file that describes a data set.
BegunFor described_design(const fs::path& folder) {
    const std::optional<Json> json = object_of(folder, "dataset_description.json");
    if (!json || !json->contains("GeneratedBy") || !json->at("GeneratedBy").is_array()) return {};
    for (const Json& by : json->at("GeneratedBy"))
        if (by.is_object() && text_at(by, "Name") == "Risorius") return text_at(*json, "Name");
    return {};
}

/// By the script of a job array.
BegunFor job_design(const fs::path& folder) {
    if (is_plain_file(folder, "code/slurm.sh") &&
        read_file(folder / "code/slurm.sh", kShellScript).find(kJobScriptMark) != std::string::npos)
        return "";
    return {};
}

/// By a clip that `batch` has made or rendered.
BegunFor clip_design(const fs::path& folder) {
    for (const fs::path& file : files_in(folder, "stimuli"))
        if (is_named_as_sidecar(file))
            if (const auto record = object_of(folder, "stimuli" / file);
                record && !clip_of(*record, file.filename().string()).empty())
                return text_at(*record, "design");
    for (const char* below : kIntermediateFolders)
        for (const fs::path& name : files_in(folder, below))
            if (name.extension() == ".json")
                if (const auto record = object_of(folder, fs::path(below) / name);
                    record && !text_at(*record, "film_sha256").empty())
                    return text_at(*record, "design");
    return {};
}

/// Whether there is any file but the private ones of runs, in the folder or below.
bool has_files(const fs::path& folder) {
    for (auto entry = fs::recursive_directory_iterator(folder);
         entry != fs::recursive_directory_iterator(); ++entry) {
        if (entry.depth() == 0 && entry->path().filename().string().starts_with(".risorius-"))
            entry.disable_recursion_pending();
        else if (!entry->is_directory() || entry->is_symlink())
            return true;
    }
    return false;
}

}  // namespace

void check_own_folder(const fs::path& folder, const std::string& design) {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder))
        throw Error(folder.string(), "a folder, or nothing yet", "a file");
    const ReadingFormerOutput former;
    if (!has_files(folder)) return;
    BegunFor begun = described_design(folder);
    if (!begun) begun = clip_design(folder);
    if (!begun) begun = job_design(folder);
    if (!begun)
        throw Error(folder.string(), "an empty folder, or one that `batch` has begun",
                    "a folder with other files");
    // Another design would remove its clips.
    if (!design.empty() && !begun->empty() && *begun != design)
        throw Error(folder.string(),
                    "a set of the design " + in_quotes(design) + ", unless " +
                        option_name("replace") + " is given",
                    "one of " + in_quotes(*begun));
}

std::set<fs::path> own_files(const fs::path& folder) {
    const ReadingFormerOutput former;
    std::set<fs::path> files = own_renders(folder);
    add_clips(folder, files);
    add_listed(folder, files);
    return files;
}

std::set<fs::path> own_renders(const fs::path& folder) {
    const ReadingFormerOutput former;
    std::set<fs::path> files;
    add_renders(folder, files);
    return files;
}

}  // namespace risorius::stimuli
