// SPDX-License-Identifier: MIT
/// \file
/// The studio of a soft body (specimen/body_session.h): the first page that comes pulls it, others look. There are no files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "risorius/serve/web_server.h"
#include "risorius/specimen/body_session.h"

namespace risorius::cli {

class StudioBody {
  public:
    /// `file`: an experiment with a body. Throws Error.
    explicit StudioBody(const std::filesystem::path& file);

    /// Serves until `stopped` returns true, or for a minute after the last page is closed.
    void run(serve::WebServer& server, const std::function<bool()>& stopped);

  private:
    struct Page {
        serve::Peer* peer;
        int credit;  ///< poses that the page is ready for
    };
    Page* page_of(const serve::Peer& peer);
    void opened(serve::Peer& peer);
    void text(serve::Peer& peer, const std::string& message);
    void closed(serve::Peer& peer);
    void tick();
    void send_pose();

    std::filesystem::path file_;
    specimen::BodySession session_;
    std::vector<Page> pages_;
    bool pose_waits_ = false, ever_seen_ = false;
    long idle_ticks_ = 0;
    double step_ms_ = 0;
};

}  // namespace risorius::cli
