// SPDX-License-Identifier: MIT
#include "risorius/view/session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/face/diagnostics.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::view {

std::string Session::error_message(const Json& id, const std::string& text) {
    return json_text(json_object({{"type", "error"}, {"id", id}, {"message", text}}));
}

Session::Session(SessionInputs inputs)
    : inputs_(std::move(inputs)),
      channels_(inputs_.rig->rig.channels()),
      document_(inputs_.script.json()),
      script_(read(document_.json())) {
    face_ =
        std::make_unique<face::Face>(inputs_.rig->rig, inputs_.rig->mesh,
                                     face::quality_named(inputs_.quality), inputs_.rig->place());
    scene_ = scene::scene_from_rig(face_->head(), inputs_.rig->rig, inputs_.rig->mesh);
    drawn_ = drawn_vertices(scene_);
    unit_m_ = unit_for(drawn_.of(scene_.rest));
    soft_ = face_->diagnostics().soft_vertices();
    std::vector<int> row(static_cast<std::size_t>(scene_.rest.rows()), -1);
    for (std::size_t i = 0; i < drawn_.vertex.size(); ++i)
        row[static_cast<std::size_t>(drawn_.vertex[i])] = static_cast<int>(i);
    for (const render::Surface& surface : scene_.surfaces) {
        if (surface.material != render::Material::kSkin) continue;
        const long before = skin_.rows();
        skin_.conservativeResize(before + surface.triangles.rows(), 3);
        for (long f = 0; f < surface.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                skin_(before + f, k) = row[static_cast<std::size_t>(surface.triangles(f, k))];
    }
    use(script_);
    compute_until(0);
    show_taken(0);
}

Session::~Session() = default;

track::ScriptDescription Session::read(const Json& script) const {
    return inputs_.read(JsonCursor::from_json(script, inputs_.script.file().string()));
}

// What the script says

long Session::last_frame() const {
    return static_cast<long>(std::floor(script_.header.duration_s * 60 + 1e-6));
}

namespace {

bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    if (a.size() != b.size()) return false;
    for (long i = 0; i < a.size(); ++i)
        if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) return false;
    return true;
}

bool same(const track::Drive& a, const track::Drive& b) {
    if (!same(a.excitation, b.excitation) || !same(a.activation, b.activation)) return false;
    if (a.kinematic != b.kinematic || a.pulls.size() != b.pulls.size()) return false;
    for (std::size_t i = 0; i < a.pulls.size(); ++i)
        if (a.pulls[i].vertex != b.pulls[i].vertex || a.pulls[i].offset_m != b.pulls[i].offset_m ||
            a.pulls[i].stiffness_n_per_m != b.pulls[i].stiffness_n_per_m)
            return false;
    return true;
}

bool same_face(const track::ScriptHeader& a, const track::ScriptHeader& b) {
    return a.jaw == b.jaw && a.motion == b.motion &&
           a.gravity_m_s2.has_value() == b.gravity_m_s2.has_value() &&
           (!a.gravity_m_s2 || *a.gravity_m_s2 == *b.gravity_m_s2);
}

}  // namespace

// Looks at four moments per frame, because pulses may be shorter than a frame.
long Session::first_change(const track::Timeline& before, const track::Timeline& after) const {
    constexpr int kMoments = 4;
    for (long moment = 0; moment < kMoments * take_.valid(); ++moment) {
        const double t_s = static_cast<double>(moment) / (60.0 * kMoments);
        if (!same(before.at(t_s), after.at(t_s))) return moment / kMoments;
    }
    return take_.valid();
}

void Session::use(track::ScriptDescription script) {
    auto timeline = std::make_unique<track::Timeline>(script, channels_);
    const bool kept = timeline_ && same_face(script.header, script_.header);
    const long valid = kept ? first_change(*timeline_, *timeline) : 0;
    script_ = std::move(script);
    timeline_ = std::move(timeline);
    take_.invalidate_from(valid);
    moments_.invalidate_from(valid);
    if (face_frame_ >= valid) face_frame_ = -1;
    if (!kept) {
        face_->drive_jaw_by(script_.header.jaw);
        face_->set_gravity(script_.header.gravity_m_s2);
        face_->move(script_.header.motion);
        face_frame_ = -1;
    }
    frame_ = std::min(frame_, last_frame());
    fails_ = false;
    make_live();
    if (!playing_ && !touched() && take_.has(frame_)) wanted_ = frame_;  // nothing changes here
}

/// The script with the overrides in place of its channels.
void Session::make_live() {
    wake();
    if (overrides_.empty()) {
        live_ = std::make_unique<track::Timeline>(*timeline_);
        return;
    }
    Json only = json_object({{"format", "risorius-script"},
                             {"version", 1},
                             {"rig", script_.header.rig},
                             {"duration_s", script_.header.duration_s}});
    for (const auto& [name, value] : overrides_)
        only["channels"][name] = json_object({{"keys", Json::array({Json::array({0, value})})}});
    const rig::RigDescription& rig = inputs_.rig->rig;
    track::ScriptDescription script = script_;
    std::erase_if(script.channels, [this](const track::ChannelTrack& track) {
        return overrides_.contains(track.name);
    });
    track::ScriptDescription added = track::read_script(JsonCursor::from_json(only, "override"),
                                                        channels_, rig.facs, rig.expressions);
    std::move(added.channels.begin(), added.channels.end(), std::back_inserter(script.channels));
    live_ = std::make_unique<track::Timeline>(script, channels_);
}

track::Drive Session::live_drive(double t_s) const {
    track::Drive drive = live_->at(t_s);
    for (const auto& [id, hand] : hands_) drive.pulls.push_back(hand.pull);
    return drive;
}

// Messages

const std::map<std::string, Session::Handler>& Session::handlers() {
    static const std::map<std::string, Handler> table{
        {"edit", &Session::edit},       {"undo", &Session::undo},
        {"redo", &Session::redo},       {"override", &Session::override_channel},
        {"release", &Session::release}, {"key", &Session::key},
        {"play", &Session::play},       {"pause", &Session::pause},
        {"seek", &Session::seek},       {"pull", &Session::pull},
        {"pull_to", &Session::pull_to}, {"pull_end", &Session::pull_end},
        {"sights", &Session::sights},   {"select", &Session::select},
        {"record", &Session::record},   {"perform", &Session::perform}};
    return table;
}

std::vector<std::string> Session::receive(const std::string& message) {
    Json id;
    std::vector<std::string> replies;
    try {
        const JsonCursor json = parse_json_text(message, "message");
        if (json.is_object() && json.json().contains("id")) id = json.json()["id"];
        const std::string type = json.at("type").string();
        const auto handler = handlers().find(type);
        if (handler == handlers().end()) {
            std::vector<std::string> known;
            for (const auto& [name, unused] : handlers()) known.push_back(name);
            json.at("type").fail("a message of the studio" + did_you_mean(type, known));
        }
        (this->*handler->second)(json);
        log_.emplace_back(ticks_, message);
    } catch (const Error& error) {
        replies.push_back(error_message(id, error.what()));
    }
    if (std::exchange(document_changed_, false)) replies.push_back(document());
    return replies;
}

void Session::edit_document(const std::vector<Operation>& operations, const std::string& gesture) {
    document_.edit(operations, gesture);
    try {
        use(read(document_.json()));
    } catch (const Error&) {
        document_.reject();
        throw;
    }
    document_changed_ = true;
}

void Session::edit(const JsonCursor& message) {
    message.allow_keys({"type", "id", "edits", "gesture"});
    std::vector<Operation> operations;
    for (const JsonCursor& one : message.at("edits").items())
        operations.push_back(read_operation(one));
    const auto gesture = message.find("gesture");
    edit_document(operations, gesture ? gesture->string() : "");
}

void Session::undo(const JsonCursor&) {
    if (!document_.undo()) return;
    use(read(document_.json()));
    document_changed_ = true;
}

void Session::redo(const JsonCursor&) {
    if (!document_.redo()) return;
    use(read(document_.json()));
    document_changed_ = true;
}

void Session::override_channel(const JsonCursor& message) {
    message.allow_keys({"type", "id", "channel", "value"});
    const std::string channel = message.at("channel").string();
    const auto before = overrides_;
    overrides_[channel] = message.at("value").number();
    try {
        make_live();
    } catch (const Error&) {
        overrides_ = before;
        make_live();
        throw;
    }
    if (recording_ && playing_) recorded_.channels[channel];
}

void Session::release(const JsonCursor& message) {
    message.allow_keys({"type", "id", "channel"});
    if (const auto channel = message.find("channel"))
        overrides_.erase(channel->string());
    else
        overrides_.clear();
    make_live();
}

/// Makes a key of an override at the playhead.
void Session::key(const JsonCursor& message) {
    message.allow_keys({"type", "id", "channel"});
    const JsonCursor name = message.at("channel");
    const auto found = overrides_.find(name.string());
    if (found == overrides_.end()) name.fail("a channel with an override");
    const std::string pointer = "/channels/" + found->first;
    const Json& script = document_.json();
    const double t_s = std::round(time_s() * 1e6) / 1e6, value = found->second;
    std::vector<Operation> operations;
    if (!script.contains("channels"))
        operations.push_back({"/channels", std::make_shared<Json>(Json::object()), {}});
    const Json::json_pointer place(pointer);
    if (!script.contains(place)) {
        const Json made = json_object({{"keys", Json::array({Json::array({t_s, value})})}});
        operations.push_back({pointer, std::make_shared<Json>(made), {}});
    } else {
        Json keys = script[place]["keys"];
        auto at = std::find_if(keys.begin(), keys.end(),
                               [&](const Json& one) { return one[0].get<double>() > t_s - 1e-4; });
        const Json made = Json::array({t_s, value});
        if (at != keys.end() && std::abs((*at)[0].get<double>() - t_s) < 1e-4)
            *at = made;
        else
            keys.insert(at, made);
        operations.push_back({pointer + "/keys", std::make_shared<Json>(std::move(keys)), {}});
    }
    const auto released = overrides_.extract(found);
    try {
        edit_document(operations, "");
    } catch (const Error&) {
        overrides_[released.key()] = released.mapped();
        make_live();
        throw;
    }
}

void Session::play(const JsonCursor& message) {
    message.allow_keys({"type", "id", "rate", "loop"});
    const auto rate = message.find("rate");
    every_ = rate ? static_cast<int>(std::lround(1 / rate->number({0.1, 1}))) : 1;
    const auto loop = message.find("loop");
    loop_ = loop && loop->boolean();
    if (frame_ >= last_frame()) frame_ = 0;
    playing_ = true;
    wanted_ = -1;
    waited_ = 0;
}

void Session::pause(const JsonCursor&) {
    playing_ = false;
    finish_recording();
    if (touched()) wake();
}

void Session::seek(const JsonCursor& message) {
    message.allow_keys({"type", "id", "t_s"});
    const double t_s = message.at("t_s").number({0, 3600});
    finish_recording();
    frame_ = std::min(std::lround(t_s * 60), last_frame());
    fails_ = false;
    if (playing_) return;
    if (touched())
        wake();
    else
        wanted_ = frame_;
}

void Session::sights(const JsonCursor& message) {
    message.allow_keys({"type", "id", "strain", "muscles", "skull"});
    if (const auto strain = message.find("strain")) with_strain_ = strain->boolean();
    const auto muscles = message.find("muscles");
    if (muscles && muscles->boolean() != with_muscles_) {
        with_muscles_ = muscles->boolean();
        if (with_muscles_) take_.invalidate_from(0);  // its poses have no muscles
        face_frame_ = -1;
        if (!playing_ && !touched()) wanted_ = frame_;
    }
    wake();
}

void Session::select(const JsonCursor& message) {
    message.allow_keys({"type", "id", "channel"});
    selected_ = message.at("channel").string();
}

Json Session::log() const {
    Json out = Json::array();
    for (const auto& [tick, message] : log_)
        out.push_back(json_object({{"tick", tick}, {"message", json_or_null(message)}}));
    return out;
}

void replay(const Json& log, Session& session) {
    for (const Json& entry : log) {
        while (session.ticks() < entry["tick"].get<long>()) session.tick();
        session.receive(json_text(entry["message"]));
    }
}

}  // namespace risorius::view
