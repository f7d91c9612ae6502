// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/face/quality.h"
#include "risorius/report/atomic_file.h"
#include "risorius/view/scene_frame.h"
#include "tools/risorius/project_files.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kResult{"a video or a picture that the page can show", 200 * kMegabyte};

/// A word of a message that becomes an argument: never one that looks like an option.
std::string word(const JsonCursor& value, const char* pattern, const std::string& expected) {
    const std::string text = value.string();
    if (!std::regex_match(text, std::regex(pattern))) value.fail(expected, in_quotes(text));
    return text;
}

std::string name_below(const fs::path& folder, const fs::path& file) {
    return file.lexically_proximate(folder).generic_string();
}

const char* type_of_result(const fs::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".png" ? "image/png" : ending == ".webm" ? "video/webm" : "video/mp4";
}

}  // namespace

fs::path StudioExport::output(const JsonCursor& message, const std::set<std::string>& endings,
                              const std::string& what) const {
    if (job_.running()) message.fail("one render at a time", "another that runs");
    const JsonCursor name = message.at("out");
    const fs::path out = in_project(folder_, name, endings, what);
    std::error_code failed;
    if (!fs::is_directory(out.parent_path(), failed))
        name.fail("a folder that exists", in_quotes(name_below(folder_, out.parent_path())));
    const auto replace = message.find("replace");
    if (fs::exists(out) && !(replace && replace->boolean()))
        message.fail("consent to replace " + in_quotes(out.filename().string()), "none");
    return out;
}

/// The file that has what is played: the saved one, or a draft beside it, where its relative paths hold.
fs::path StudioExport::script_file(const ScriptNow& script, const fs::path& out) {
    draft_.reset();
    if (script.saved) return script.file;
    const fs::path near = script.file.empty() ? folder_ : script.file.parent_path();
    Draft draft{near / (out.filename().string() + ".script.json"), std::nullopt};
    const ReadingFormerOutput drafts_are_replaced;
    if (fs::exists(draft.file)) draft.before = read_json_text(draft.file);
    OutputSet outputs(near, OutputSet::Then::kRunGoesOn);
    report::write_text(outputs.file(draft.file), script.text);
    outputs.commit();
    draft_ = draft;
    return draft.file;
}

/// The draft of a video that has not come about.
void StudioExport::drop_draft() {
    if (!draft_) return;
    const Draft draft = *std::exchange(draft_, std::nullopt);
    try {
        const ReadingFormerOutput drafts_are_replaced;
        OutputSet outputs(draft.file.parent_path(), OutputSet::Then::kRunGoesOn);
        if (draft.before)
            report::write_text(outputs.file(draft.file), *draft.before);
        else
            outputs.removal(draft.file);
        outputs.commit();
    } catch (const std::exception&) {
        // It is a whole script, and does no harm.
    }
}

void StudioExport::render(const JsonCursor& message, const ScriptNow& script,
                          serve::WebServer& server, Tell tell) {
    message.allow_keys(
        {"type", "id", "out", "size", "quality", "camera", "sound", "still_s", "replace"});
    const auto still = message.find("still_s");
    const fs::path out = still ? output(message, {".png"}, "a picture .png")
                               : output(message, {".mp4", ".webm", ".mkv", ".mov"},
                                        "a video .mp4, .webm, .mkv or .mov");
    std::vector<std::string> options{"--out", out.string()};
    if (still) options.insert(options.end(), {"--still", format_number(still->number({0, 3600}))});
    if (const auto size = message.find("size"))
        options.insert(options.end(), {"--size", word(*size, "[1-9][0-9]{0,4}x[1-9][0-9]{0,4}",
                                                      "a size in pixels, such as 640x480")});
    if (const auto camera = message.find("camera"))
        options.insert(options.end(), {"--camera", word(*camera, "[a-z_]{1,40}", "a camera")});
    if (const auto quality = message.find("quality")) {
        (void)face::quality_named(quality->string());
        options.insert(options.end(), {"--quality", quality->string()});
    }
    const auto sound = message.find("sound");
    if (sound && !sound->boolean() && !still) options.push_back("--no-sound");
    std::vector<std::string> arguments{"render", script_file(script, out).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    start(still ? "picture" : "video", out, arguments, server, std::move(tell));
}

void StudioExport::shapes(const JsonCursor& message, const ScriptNow& script,
                          serve::WebServer& server, Tell tell) {
    message.allow_keys({"type", "id", "out", "set", "quality", "replace"});
    const fs::path out = output(message, {""}, "a folder without an ending");
    std::vector<std::string> arguments{"shapes", script.rig.string(), "--out", out.string()};
    if (const auto set = message.find("set"))
        arguments.insert(arguments.end(),
                         {"--set", word(*set, "[a-z0-9]{1,20}", "a set of shapes")});
    if (const auto quality = message.find("quality")) {
        (void)face::quality_named(quality->string());
        arguments.insert(arguments.end(), {"--quality", quality->string()});
    }
    draft_.reset();
    start("shapes", out, arguments, server, std::move(tell));
}

void StudioExport::start(const std::string& what, const fs::path& out,
                         const std::vector<std::string>& arguments, serve::WebServer& server,
                         Tell tell) {
    const auto told = [this, what, out = name_below(folder_, out), tell](
                          const char* state, double fraction, const std::string& text) {
        Json json = json_object({{"type", "job"},
                                 {"what", what},
                                 {"state", state},
                                 {"fraction", fraction},
                                 {"text", text},
                                 {"out", out}});
        if (draft_) json["script"] = name_below(folder_, draft_->file);
        last_ = json_text(json);
        tell(last_);
    };
    job_.start(arguments, server,
               {.progress = [told](double fraction,
                                   const std::string& text) { told("running", fraction, text); },
                .ended =
                    [this, told, out](int exit_code, bool cancelled, const std::string& text) {
                        made_ = exit_code == 0 ? out : fs::path();
                        if (exit_code != 0) drop_draft();
                        told(exit_code == 0 ? "done"
                             : cancelled    ? "cancelled"
                                            : "failed",
                             exit_code == 0 ? 1 : 0, text);
                        draft_.reset();
                    }});
    told("running", 0, "");
}

void StudioExport::finish() {
    const bool ran = job_.running();
    job_.finish();
    if (ran) drop_draft();
}

std::string StudioExport::result(const JsonCursor& message) const {
    message.allow_keys({"type", "id"});
    if (made_.empty() || made_.extension().empty())
        message.fail("a video or a picture that has been made", "none");
    return view::encode_file(made_.filename().string(), type_of_result(made_),
                             read_file(made_, kResult));
}

}  // namespace risorius::cli
