// SPDX-License-Identifier: MIT
/// \file
/// Small pictures of scripts for the list of the studio: made when the page asks, one after the other on a thread of their own, and kept
/// between runs (core/result_cache.h).
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "risorius/core/json_text.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/serve/web_server.h"

namespace risorius::cli {

inline constexpr int kThumbnail_px = 128;

/// The face at the moment at which the channels of the script drive its muscles most, as the bytes of a PNG. What the script says is
/// left out. Throws Error when the script or its rig cannot be used, and Interrupted.
std::string thumbnail_of(const std::filesystem::path& script, const ProgressMonitor& monitor = {});

/// Bytes as base64 (RFC 4648).
std::string base64_of(const std::string& bytes);

class StudioThumbnails {
  public:
    using Tell = std::function<void(const std::string& message)>;

    /// Makes the picture of a script. `about`: {"type": "thumbnail", "path" or "sample": ...}; `tell` gets it with "png", in base64, on the
    /// thread of the server. "png" is "" where there can be no picture. What is asked for twice is made once.
    void ask(const std::filesystem::path& script, Json about, serve::WebServer& server, Tell tell);

    /// Drops what waits, and waits for the picture that is made.
    void finish();

  private:
    struct Wanted {
        std::filesystem::path script;
        Json about;
        Tell tell;
    };
    void work(const std::stop_token& asked, serve::WebServer& server);

    std::mutex mutex_;
    std::condition_variable_any came_;
    std::deque<Wanted> waiting_;
    std::unique_ptr<std::jthread> thread_;
};

}  // namespace risorius::cli
