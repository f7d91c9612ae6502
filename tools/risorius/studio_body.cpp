// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_body.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/studio_page.h"

namespace risorius::cli {

namespace fs = std::filesystem;

StudioBody::StudioBody(const fs::path& file)
    : file_(fs::weakly_canonical(fs::absolute(file))), session_(JsonCursor::read_file(file)) {}

void StudioBody::run(serve::WebServer& server, const std::function<bool()>& stopped) {
    const serve::Handler handler{
        .opened = [this](serve::Peer& peer) { opened(peer); },
        .text = [this](serve::Peer& peer, const std::string& message) { text(peer, message); },
        .binary = {},
        .closed = [this](serve::Peer& peer) { closed(peer); },
        .tick = [this] { tick(); }};
    server.run(handler, [&] { return stopped() || idle_ticks_ > kTicksWithoutPage; });
}

StudioBody::Page* StudioBody::page_of(const serve::Peer& peer) {
    const auto found = std::find_if(pages_.begin(), pages_.end(),
                                    [&](const Page& page) { return page.peer == &peer; });
    return found == pages_.end() ? nullptr : &*found;
}

void StudioBody::opened(serve::Peer& peer) {
    pages_.push_back({&peer, kFirstCredit});
    ever_seen_ = true;
    idle_ticks_ = 0;
    Json welcome = json_or_null(session_.welcome());
    welcome["steers"] = pages_.size() == 1;
    welcome["folder"] = file_.parent_path().string();
    welcome["file"] = file_.filename().string();
    peer.send_text(json_text(welcome));
    peer.send_binary(std::make_shared<const std::string>(session_.scene()));
    peer.send_text(session_.document());
    pose_waits_ = true;
}

void StudioBody::closed(serve::Peer& peer) {
    const bool steered = !pages_.empty() && pages_.front().peer == &peer;
    std::erase_if(pages_, [&](const Page& page) { return page.peer == &peer; });
    if (!steered) return;
    // Nobody holds the body any more.
    const Json state = json_or_null(session_.state());
    for (const Json& pull : state["pulls"])
        session_.receive(json_text(json_object({{"type", "pull_end"}, {"pull", pull["pull"]}})));
    if (!pages_.empty())
        pages_.front().peer->send_text(
            json_text(json_object({{"type", "steers"}, {"steers", true}})));
}

void StudioBody::text(serve::Peer& peer, const std::string& message) {
    Page* page = page_of(peer);
    if (!page) return;
    const Json json = json_or_null(message);
    if (json.is_object() && json.value("type", Json()) == Json("credit")) {
        page->credit = std::min(page->credit + 1, kFirstCredit);
        return;
    }
    if (page != &pages_.front()) {
        const Json id = json.is_object() ? json.value("id", Json()) : Json();
        peer.send_text(
            json_text(json_object({{"type", "error"},
                                   {"id", id},
                                   {"message", "this page only looks: another one steers"}})));
        return;
    }
    for (const std::string& reply : session_.receive(message)) peer.send_text(reply);
    pose_waits_ = true;
}

void StudioBody::tick() {
    const bool nobody = pages_.empty() && ever_seen_;
    idle_ticks_ = nobody ? idle_ticks_ + 1 : 0;
    if (pages_.empty()) return;
    const auto begin = std::chrono::steady_clock::now();
    if (session_.tick()) {
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begin;
        step_ms_ += 0.1 * (took.count() - step_ms_);
        pose_waits_ = true;
    }
    for (const std::string& event : session_.events())
        for (const Page& page : pages_) page.peer->send_text(event);
    send_pose();
}

/// As of a face: what a slow page misses is left out; the steps are not.
void StudioBody::send_pose() {
    const auto ready = [](const Page& page) {
        return page.credit > 0 && page.peer->waiting() < kMostWaiting;
    };
    if (!pose_waits_ || std::none_of(pages_.begin(), pages_.end(), ready)) return;
    pose_waits_ = false;
    const auto pose = std::make_shared<const std::string>(session_.pose());
    Json state = json_or_null(session_.state());
    state["step_ms"] = std::round(step_ms_ * 10) / 10;
    const std::string text = json_text(state);
    for (Page& page : pages_) {
        if (!ready(page)) continue;
        --page.credit;
        page.peer->send_text(text);
        page.peer->send_binary(pose);
    }
}

}  // namespace risorius::cli
