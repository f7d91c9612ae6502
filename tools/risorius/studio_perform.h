// SPDX-License-Identifier: MIT
/// \file
/// Camera performance in the studio: learns how the rig looks to the face network, then turns pictures of the page into values of
/// channels. Pictures are only looked at; they are neither kept nor sent on.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "risorius/core/image.h"
#include "risorius/core/json_cursor.h"
#include "risorius/perform/performer.h"
#include "risorius/serve/web_server.h"

namespace risorius::cli {

/// A picture of the page: 24 bytes of header (uint32 kind 1, width, height, 0; float64 time, ms), then width x height x RGBA.
/// Throws Error for other bytes.
struct CameraPicture {
    double t_s = 0;
    Image image;
};
CameraPicture read_camera_picture(const std::string& bytes);

class StudioPerform {
  public:
    /// What it tells, on the thread of the server: messages for all pages, and values of channels for the session.
    struct Listener {
        std::function<void(const std::string& message)> tell;
        std::function<void(const std::map<std::string, double>& values)> values;
    };

    /// Reads {"type": "camera", "do": "start" | "calibrate" | "stop"}, and with "calibrate" a "pose": "rest" or a name of
    /// perform::ranges(). "start" learns the rig once, in a minute or two; meanwhile and
    /// then it tells {"type": "camera", "state": "learning", "fraction": 0.3, "text": "AU12.l"} and {"state": "ready",
    /// "channels": [{"name": "AU12.l", "reliable": true, "error": 0.06}]}, or {"state": "failed", "text": ...}. Throws Error for
    /// another message, and when the weights of the network are missing.
    void receive(const JsonCursor& message, const std::shared_ptr<const scene::RigFiles>& rig,
                 serve::WebServer& server, Listener listener);

    /// Looks at a picture; {"type": "performed", "score": 0.98, "calibrated": true, "ranges": {"smile": "known"}, "values": {...},
    /// "ms": 31} says that the next one may come. A picture that comes earlier takes the place of the one that waits.
    void picture(const std::string& bytes);

    /// Another rig is open, or the studio ends.
    void finish();

  private:
    void learn(const std::stop_token& asked, const std::shared_ptr<const scene::RigFiles>& rig);
    void look(const std::stop_token& asked);
    void post(std::function<void(const Listener&)> what);

    serve::WebServer* server_ = nullptr;
    std::shared_ptr<const Listener>
        listener_;  // null: stopped; only the thread of the server changes it
    std::shared_ptr<const perform::Networks> networks_;
    std::shared_ptr<const perform::RigReader> reader_;
    const scene::RigFiles* learned_ = nullptr;
    std::mutex mutex_;
    std::condition_variable_any came_;
    std::optional<CameraPicture> waiting_;
    std::string
        calibrate_;  // what is to be calibrated next: "rest", the name of a range, or nothing
    std::unique_ptr<std::jthread> thread_;
};

}  // namespace risorius::cli
