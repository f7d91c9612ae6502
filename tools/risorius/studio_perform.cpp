// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_perform.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/landmarks/face_network.h"
#include "risorius/perform/rig_reader.h"

namespace risorius::cli {

namespace {

constexpr std::uint32_t kPictureOfCamera = 1, kMostSide_px = 640, kLeastSide_px = 32;

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T out{};
    std::memcpy(&out, bytes.data() + at, sizeof out);
    return out;
}

Json ready_message(const perform::RigReader& reader) {
    Json channels = Json::array();
    for (const perform::CameraChannel& one : reader.channels)
        channels.push_back(json_object({{"name", one.name},
                                        {"reliable", one.reliable},
                                        {"error", std::round(100 * one.error) / 100}}));
    return json_object({{"type", "camera"}, {"state", "ready"}, {"channels", channels}});
}

constexpr const char* kRest = "rest";

std::vector<std::string_view> calibrated_poses() {
    std::vector<std::string_view> out{kRest};
    for (const perform::Range& range : perform::ranges()) out.push_back(range.name);
    return out;
}

void calibrate(const std::string& pose, perform::Performer& performer) {
    if (pose == kRest) performer.calibrate();
    for (std::size_t k = 0; k < perform::ranges().size(); ++k)
        if (pose == perform::ranges()[k].name) performer.calibrate_range(k);
}

/// The ranges that a person has shown: {"smile": "known", "open": "small"}.
Json ranges_json(const perform::Performer& performer) {
    using State = perform::Performer::RangeState;
    Json out = Json::object();
    for (std::size_t k = 0; k < perform::ranges().size(); ++k)
        if (performer.ranges_state()[k] != State::kNone)
            out[perform::ranges()[k].name] =
                performer.ranges_state()[k] == State::kKnown ? "known" : "small";
    return out;
}

}  // namespace

CameraPicture read_camera_picture(const std::string& bytes) {
    constexpr std::size_t kHeader = 24;
    const char* place = "picture";
    if (bytes.size() < kHeader || number_at<std::uint32_t>(bytes, 0) != kPictureOfCamera)
        throw Error(place, "a picture of a camera", "other bytes");
    const auto width = number_at<std::uint32_t>(bytes, 4),
               height = number_at<std::uint32_t>(bytes, 8);
    for (const std::uint32_t side : {width, height})
        if (side < kLeastSide_px || side > kMostSide_px)
            throw Error(place, "sides of 32 to 640 pixels", std::to_string(side));
    CameraPicture out{number_at<double>(bytes, 16) / 1000,
                      Image(static_cast<int>(width), static_cast<int>(height))};
    if (!std::isfinite(out.t_s) || bytes.size() != kHeader + out.image.rgba.size())
        throw Error(place, std::to_string(kHeader + out.image.rgba.size()) + " bytes and a time",
                    std::to_string(bytes.size()) + " bytes");
    std::memcpy(out.image.rgba.data(), bytes.data() + kHeader, out.image.rgba.size());
    return out;
}

void StudioPerform::post(std::function<void(const Listener&)> what) {
    server_->post([this, what = std::move(what)] {
        if (listener_) what(*listener_);
    });
}

void StudioPerform::receive(const JsonCursor& message,
                            const std::shared_ptr<const scene::RigFiles>& rig,
                            serve::WebServer& server, Listener listener) {
    message.allow_keys({"type", "id", "do", "pose"});
    const std::string what = message.at("do").one_of({"start", "calibrate", "stop"});
    if (what == "calibrate") {
        const std::string pose =
            message.has("pose") ? message.at("pose").one_of(calibrated_poses()) : kRest;
        const std::lock_guard lock(mutex_);
        calibrate_ = pose;
        return;
    }
    if (what == "stop") {
        finish();
        listener.values({});
        return;
    }
    finish();
    if (!networks_) networks_ = std::make_shared<perform::Networks>(landmarks::weights_folder());
    server_ = &server;
    listener_ = std::make_shared<const Listener>(std::move(listener));
    if (learned_ != rig.get()) reader_.reset();
    learned_ = rig.get();
    thread_ = std::make_unique<std::jthread>([this, rig](const std::stop_token& asked) {
        try {
            if (!reader_) learn(asked, rig);
            post(
                [text = json_text(ready_message(*reader_))](const Listener& to) { to.tell(text); });
            look(asked);
        } catch (const Interrupted&) {
        } catch (const std::exception& error) {
            post([text = json_text(json_object(
                      {{"type", "camera"}, {"state", "failed"}, {"text", error.what()}}))](
                     const Listener& to) { to.tell(text); });
        }
    });
}

void StudioPerform::learn(const std::stop_token& asked,
                          const std::shared_ptr<const scene::RigFiles>& rig) {
    const ProgressMonitor monitor{
        .progress =
            [this](double fraction, const std::string& what) {
                const Json told = json_object({{"type", "camera"},
                                               {"state", "learning"},
                                               {"fraction", fraction},
                                               {"text", what}});
                post([text = json_text(told)](const Listener& to) { to.tell(text); });
            },
        .stopped = [&] { return asked.stop_requested(); }};
    reader_ =
        std::make_shared<const perform::RigReader>(perform::learn_rig(rig, *networks_, monitor));
}

void StudioPerform::look(const std::stop_token& asked) {
    using Clock = std::chrono::steady_clock;
    perform::Performer performer(networks_, reader_);
    while (!asked.stop_requested()) {
        CameraPicture picture;
        {
            std::unique_lock lock(mutex_);
            if (!came_.wait(lock, asked, [&] { return waiting_.has_value(); })) return;
            picture = std::move(*waiting_);
            waiting_.reset();
            calibrate(std::exchange(calibrate_, ""), performer);
        }
        const Clock::time_point begin = Clock::now();
        const perform::Performed seen = performer.see(picture.image, picture.t_s);
        const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
        Json values = Json::object();
        for (const auto& [name, value] : seen.values) values[name] = std::round(1e3 * value) / 1e3;
        const Json told = json_object({{"type", "performed"},
                                       {"score", std::round(100 * seen.score) / 100},
                                       {"calibrating", seen.calibrating},
                                       {"calibrated", performer.calibrated()},
                                       {"ranges", ranges_json(performer)},
                                       {"values", values},
                                       {"ms", std::round(took.count())}});
        post([text = json_text(told), values = seen.values](const Listener& to) {
            to.tell(text);
            if (!values.empty()) to.values(values);
        });
    }
}

void StudioPerform::picture(const std::string& bytes) {
    CameraPicture read = read_camera_picture(bytes);
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(read);
    came_.notify_one();
}

void StudioPerform::finish() {
    listener_.reset();
    thread_.reset();  // asks it to stop, and waits
    const std::lock_guard lock(mutex_);
    waiting_.reset();
    calibrate_.clear();
}

}  // namespace risorius::cli
