// SPDX-License-Identifier: MIT
// The pulls of a hand in a session, and what a session says about itself.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/face/diagnostics.h"
#include "risorius/view/detail/channel_list.h"
#include "risorius/view/detail/pull_recorder.h"
#include "risorius/view/session.h"

namespace risorius::view {

namespace {

constexpr std::size_t kMostHands = 10;  // fingers

int id_of_pull(const JsonCursor& message) { return message.at("pull").integer(0, 1000000); }

}  // namespace

/// The offset of a point in the world from a vertex at rest, not farther than a script may say.
Vec3 Session::offset_of(int vertex, const JsonCursor& point_m) const {
    const Vec3 rest = scene_.rest.row(vertex).transpose();
    const Vec3 offset = point_m.vec3() - rest;
    const double most_m = 1e-3 * track::kFarthestPull_mm;
    return offset * std::min(1.0, most_m / std::max(offset.norm(), 1e-12));
}

void Session::pull(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull", "vertex", "point_m", "stiffness_n_per_m", "record"});
    const int id = id_of_pull(message);
    const int vertices = static_cast<int>(scene_.rest.rows());
    HandPull hand;
    hand.pull.vertex = message.at("vertex").integer(0, vertices - 1);
    if (!soft_[static_cast<std::size_t>(hand.pull.vertex)])
        message.at("vertex").fail("a vertex that soft tissue moves");
    if (const auto k = message.find("stiffness_n_per_m"))
        hand.pull.stiffness_n_per_m = k->number({track::kMinPull_n_per_m, track::kMaxPull_n_per_m});
    hand.pull.offset_m = offset_of(hand.pull.vertex, message.at("point_m"));
    if (const auto record = message.find("record")) hand.recorded = record->boolean();
    hand.recorded = hand.recorded || (recording_ && playing_);
    hand.begin_s = time_s();
    if (hands_.size() >= kMostHands && !hands_.contains(id))
        message.at("pull").fail("at most " + std::to_string(kMostHands) + " pulls at a time");
    hands_[id] = std::move(hand);
    wanted_ = -1;
    wake();
}

void Session::pull_to(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull", "point_m", "stiffness_n_per_m"});
    const auto found = hands_.find(id_of_pull(message));
    if (found == hands_.end()) return;  // it was let go of meanwhile
    track::Pull& pull = found->second.pull;
    pull.offset_m = offset_of(pull.vertex, message.at("point_m"));
    if (const auto k = message.find("stiffness_n_per_m"))
        pull.stiffness_n_per_m = k->number({track::kMinPull_n_per_m, track::kMaxPull_n_per_m});
    wake();
}

track::PullTrack Session::track_of(const HandPull& hand) {
    return {hand.pull.vertex, hand.pull.stiffness_n_per_m, thinned(hand.keys, kStraight_mm)};
}

void Session::pull_end(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull"});
    const auto found = hands_.find(id_of_pull(message));
    if (found == hands_.end()) return;
    HandPull hand = std::move(found->second);
    hands_.erase(found);
    wake();
    if (!hand.recorded || hand.keys.size() < 2) return;
    const track::PullTrack track = track_of(hand);
    if (recording_) {
        recorded_.pulls.push_back(track);
        return;
    }
    std::vector<Operation> operations;
    const Json& script = document_.json();
    std::size_t count = 0;
    if (script.contains("pulls"))
        count = script["pulls"].size();
    else
        operations.push_back({"/pulls", std::make_shared<Json>(Json::array()), {}});
    operations.push_back(
        {"/pulls/" + std::to_string(count), std::make_shared<Json>(pull_json(track)), {}});
    edit_document(operations, "");
}

/// While the script plays, keys have its times; while it stands still, time begins at the playhead.
void Session::record_hands() {
    for (auto& [id, hand] : hands_) {
        if (!hand.recorded) continue;
        const double t_s =
            playing_ ? time_s() : hand.begin_s + static_cast<double>(hand.keys.size()) / 60;
        if (t_s > script_.header.duration_s) continue;
        if (!hand.keys.empty() && t_s <= hand.keys.back().time_s) continue;
        hand.keys.push_back({t_s, 1e3 * hand.pull.offset_m});
    }
}

void Session::record(const JsonCursor& message) {
    message.allow_keys({"type", "id", "on"});
    const bool on = message.at("on").boolean();
    if (!on) finish_recording();
    recording_ = on;
}

/// Overrides of many channels at once, by a camera; those that it does not name any more are let go of.
void Session::perform(const JsonCursor& message) {
    message.allow_keys({"type", "id", "values"});
    const JsonCursor values = message.at("values");
    const auto before = overrides_;
    const auto performed_before = performed_;
    for (const std::string& name : std::exchange(performed_, {})) overrides_.erase(name);
    for (const std::string& name : values.keys()) {
        overrides_[name] = values.at(name).number();
        performed_.insert(name);
    }
    try {
        make_live();
    } catch (const Error&) {
        overrides_ = before;
        performed_ = performed_before;
        make_live();
        throw;
    }
    if (recording_ && playing_)
        for (const std::string& name : performed_) recorded_.channels[name];
}

/// A channel that was moved since recording began has its value at every frame from then on, until it is let go of.
void Session::record_channels() {
    if (!recording_) return;
    for (auto& [name, samples] : recorded_.channels)
        if (const auto now = overrides_.find(name);
            now != overrides_.end() && (samples.empty() || time_s() > samples.back().time_s))
            samples.push_back({time_s(), now->second});
}

/// Writes what was recorded into the script, and lets go of it: now the script does it.
void Session::finish_recording() {
    if (!std::exchange(recording_, false)) return;
    for (auto& [id, hand] : hands_) {
        if (!std::exchange(hand.recorded, false) || hand.keys.size() < 2) continue;
        recorded_.pulls.push_back(track_of(hand));
        hand.keys.clear();
    }
    Recording recorded = std::exchange(recorded_, {});
    std::erase_if(recorded.channels, [](const auto& one) { return one.second.empty(); });
    if (recorded.empty()) return;
    for (const auto& [name, unused] : recorded.channels) overrides_.erase(name);
    try {
        edit_document(recording_edits(recorded, document_.json(), script_), "");
    } catch (const Error& error) {
        make_live();
        events_.push_back(error_message(nullptr, error.what()));
        return;
    }
    document_changed_ = true;
    if (!playing_ && !touched()) wanted_ = frame_;
}

std::string Session::welcome() const {
    const rig::RigDescription& rig = inputs_.rig->rig;
    Json expressions = Json::array();
    for (const track::Expression& one : rig.expressions.list)
        expressions.push_back(json_object({{"name", one.name},
                                           {"onset_s", one.onset_s},
                                           {"hold_s", one.hold_s},
                                           {"offset_s", one.offset_s}}));
    return json_text(json_object({{"type", "welcome"},
                                  {"protocol", 1},
                                  {"rig", rig.name},
                                  {"script", inputs_.script.file().filename().string()},
                                  {"quality", inputs_.quality},
                                  {"channels", channel_list(rig)},
                                  {"columns", channels_.column_names()},
                                  {"expressions", expressions}}));
}

std::string Session::document() const {
    return json_text(json_object({{"type", "document"},
                                  {"script", document_.json()},
                                  {"revision", document_.revision()},
                                  {"dirty", document_.dirty()},
                                  {"undo", document_.can_undo()},
                                  {"redo", document_.can_redo()},
                                  {"duration_s", script_.header.duration_s},
                                  {"curves", curve_samples(script_)},
                                  {"recorded", recorded_samples(script_)}}));
}

std::string Session::muscles() const { return encode_muscles(face_->surfaces().muscles()); }

std::string Session::scene() const { return encode_scene(scene_, drawn_, soft_, unit_m_); }

namespace {

Json point_json(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

std::string Session::state() const {
    Json overrides = Json::object();
    for (const auto& [name, value] : overrides_) overrides[name] = value;
    Json pulls = Json::array();
    const std::vector<face::HeldPull> held =
        hands_.empty() ? std::vector<face::HeldPull>{} : face_->diagnostics().pulls();
    // The hands come last in the drive of the last step; a hand that has just come is not in it yet.
    std::size_t at = held.size() >= hands_.size() ? held.size() - hands_.size() : held.size();
    for (const auto& [id, hand] : hands_) {
        if (at >= held.size() || held[at].vertex != hand.pull.vertex) continue;
        const face::HeldPull& one = held[at++];
        pulls.push_back(json_object({{"pull", id},
                                     {"vertex", one.vertex},
                                     {"point_m", point_json(one.point)},
                                     {"hand_m", point_json(one.hand)},
                                     {"force_n", one.force_n},
                                     {"moved_mm", 1e3 * one.moved_m},
                                     {"stiffness_n_per_m", hand.pull.stiffness_n_per_m}}));
    }
    Json selected = Json::object();
    const track::SidedName name = track::split_side(selected_);
    if (const track::MuscleChannel* muscle = channels_.find(name.id)) {
        selected["channel"] = selected_;
        for (const Side side : {Side::kLeft, Side::kRight})
            if (muscle->paired || side == Side::kLeft)
                if (const auto found = face_->diagnostics().muscle_state(name.id, side))
                    selected[side == Side::kLeft ? "l" : "r"] = json_object(
                        {{"force_n", found->force_n}, {"length_mm", 1e3 * found->length_m}});
    }
    return json_text(json_object(
        {{"type", "state"},
         {"tick", ticks_},
         {"t_s", time_s()},
         {"playing", playing_},
         {"recording", recording_},
         {"computing", (playing_ && !take_.has(frame_)) || (wanted_ >= 0 && !touched())},
         {"computed_s", static_cast<double>(std::max(0L, take_.valid() - 1)) / 60},
         {"resting", !playing_ && (touched() || wanted_ < 0) && quiet_ >= kQuietTicks},
         {"dirty", document_.dirty()},
         {"overrides", overrides},
         {"pulls", pulls},
         {"selected", selected}}));
}

}  // namespace risorius::view
