// SPDX-License-Identifier: MIT
/// \file
/// What the studio makes of the open script: videos, pictures and blend shapes. The commands `render` and `shapes` of this program
/// make them, in a process of their own, one at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "risorius/core/json_cursor.h"
#include "risorius/serve/web_server.h"
#include "tools/risorius/child_job.h"

namespace risorius::cli {

/// The script as it is played now.
struct ScriptNow {
    std::filesystem::path file;  ///< where it is saved; empty: it has no name yet
    bool saved = false;          ///< the file has what is played
    std::string text;
    std::filesystem::path rig;
};

class StudioExport {
  public:
    using Tell = std::function<void(const std::string& message)>;

    /// `folder`: the project, canonical. Everything is written below it.
    explicit StudioExport(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Reads {"type": "render", "out": "smile.mp4", "size": "640x480", "quality": "preview", "camera": "front", "sound": true,
    /// "still_s": 1.2, "replace": true}; with "still_s", a picture of that moment. A script that is not saved is written beside the
    /// saved one as OUT.script.json, and stays there with the finished video. `tell` gets {"type": "job", "what": "video", "state":
    /// "running", "fraction": 0.4, "text": "frame 20 of 50", "out": "smile.mp4"} and at last the state "done", "failed" or "cancelled".
    /// Throws Error for a wrong message, while another job runs, and when a file exists and "replace" is not true.
    void render(const JsonCursor& message, const ScriptNow& script, serve::WebServer& server,
                Tell tell);

    /// Reads {"type": "shapes", "out": "shapes", "set": "arkit52", "replace": true}, and makes blend shapes of the rig.
    void shapes(const JsonCursor& message, const ScriptNow& script, serve::WebServer& server,
                Tell tell);

    void cancel() { job_.cancel(); }
    bool running() const { return job_.running(); }
    void finish();

    /// The message about the last job, "" when there has been none.
    const std::string& last() const { return last_; }
    /// The bytes of the last video or picture for the page: kind 7 (view/scene_frame.h). Throws Error when there is none, or it is
    /// too large.
    std::string result(const JsonCursor& message) const;

  private:
    struct Draft {
        std::filesystem::path file;
        std::optional<std::string> before;  ///< what the file had
    };
    void start(const std::string& what, const std::filesystem::path& out,
               const std::vector<std::string>& arguments, serve::WebServer& server, Tell tell);
    std::filesystem::path script_file(const ScriptNow& script, const std::filesystem::path& out);
    void drop_draft();
    std::filesystem::path output(const JsonCursor& message, const std::set<std::string>& endings,
                                 const std::string& what) const;

    std::filesystem::path folder_;
    ChildJob job_;
    std::optional<Draft> draft_;
    std::filesystem::path made_;  ///< by the last job
    std::string last_;
};

}  // namespace risorius::cli
