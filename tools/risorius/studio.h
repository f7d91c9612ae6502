// SPDX-License-Identifier: MIT
/// \file
/// The studio: a session, the server of its page, and the files that the page may read and write.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/serve/web_server.h"
#include "risorius/view/session.h"
#include "tools/risorius/child_job.h"
#include "tools/risorius/studio_drop.h"
#include "tools/risorius/studio_export.h"
#include "tools/risorius/studio_head.h"
#include "tools/risorius/studio_perform.h"
#include "tools/risorius/studio_sound.h"
#include "tools/risorius/studio_thumbnails.h"

namespace risorius::cli {

/// A script that is open, and its file.
struct OpenScript {
    std::filesystem::path file;  ///< where it is saved; empty: it has no name yet
    std::filesystem::path rig;
    std::shared_ptr<const scene::RigFiles> rig_files;
    std::string on_disk;  ///< the bytes of the file when it was read or written last
    std::unique_ptr<view::Session> session;
};

/// Connects the pages with the session. All members run on the thread of the server.
class Studio {
  public:
    /// `file`: a script, a rig, a mesh that is to become one, or nothing for the adult. Files are read and written below the folder of
    /// the file, or the current one. Throws Error.
    Studio(const std::filesystem::path& file, const std::string& quality);
    ~Studio();

    /// Serves until `stopped` returns true, or for a minute after the last page is closed. What is not saved then is written beside
    /// the script as NAME.recovered.json.
    void run(serve::WebServer& server, const std::function<bool()>& stopped);

  private:
    struct Page {
        serve::Peer* peer;
        int credit = 0;  ///< poses that the page is ready for
        bool has_muscles = false;
        bool wants_muscles = false;
        bool wants_skull = false, has_skull = false;
    };

    void open(const std::filesystem::path& file);
    void opened(serve::Peer& peer);
    void text(serve::Peer& peer, const std::string& message);
    void binary(serve::Peer& peer, const std::string& bytes);
    void dropped(const std::filesystem::path& file);
    void open_for_all(const std::filesystem::path& file);
    void camera(const JsonCursor& message);
    void closed(serve::Peer& peer);
    void tick();
    void greet(Page& page);
    void tell_all(const std::string& message);
    void tell_document(const std::string& document);
    void send_sound(const Page& page) const;
    void send_pose(bool always);
    void save(const JsonCursor& message);
    void say(serve::Peer& peer, const JsonCursor& message);
    void make_voice(const JsonCursor& message);
    void new_head(serve::Peer& peer, const std::string& type, const JsonCursor& message);
    ScriptNow script_now() const;
    void make(serve::Peer& peer, const std::string& type, const JsonCursor& message);
    void write_recovery() const;
    void make_skull();
    void send_skull();
    void make_pictures(serve::WebServer& server);
    Page* page_of(const serve::Peer& peer);
    std::filesystem::path project_script(const JsonCursor& name) const;
    std::filesystem::path listed_script(const JsonCursor& message) const;
    void thumbnail(const JsonCursor& message);

    std::string quality_;
    bool start_;                    ///< nothing was named: pages begin with the list of scripts
    std::string mesh_;              ///< of which a rig is to be made first, below the folder, or ""
    std::filesystem::path folder_;  ///< the project: canonical
    animate::RenderInputs inputs_;
    std::unique_ptr<StudioHead> head_;
    std::unique_ptr<StudioDrop> drop_;
    std::unique_ptr<StudioExport> export_;
    StudioPerform perform_;
    StudioThumbnails thumbnails_;
    ChildJob voice_;
    OpenScript script_;
    ScriptSound planned_, sound_;  ///< of the script that was read last; what the pages have
    std::vector<Page> pages_;
    std::vector<std::shared_ptr<const std::string>> pictures_;
    std::shared_ptr<const std::string> scene_;
    serve::WebServer* server_ = nullptr;
    std::unique_ptr<std::jthread> painter_, bones_;
    std::shared_ptr<const std::string> skull_;  ///< null: not wanted yet, or being estimated
    bool pose_waits_ = false, ever_seen_ = false;
    long idle_ticks_ = 0;
    double step_ms_ = 0;
};

}  // namespace risorius::cli
