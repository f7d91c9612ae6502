// SPDX-License-Identifier: MIT
#include "risorius/specimen/body_session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/softbody/mesh_body.h"
#include "risorius/track/pull_track.h"
#include "risorius/view/pose_frame.h"

namespace risorius::specimen {

namespace {

constexpr double kStep_s = 1.0 / 60;
constexpr double kShown_m = 0.15;    // longest edge on the page
constexpr std::size_t kHands = 10;   // fingers
constexpr int kQuietTicks = 12;      // then the body rests
constexpr double kStill = 1e-6;      // of its longest edge, in a step
constexpr double kFarthestPull = 3;  // of its longest edge
constexpr double kDuration_s = 4;    // of the ruler of the page

softbody::SoftBody built(const JsonCursor& experiment) {
    const auto body = experiment.find("body");
    if (!body) experiment.fail("an experiment with a \"body\", which can be pulled", "none");
    const softbody::SoftBody out = softbody::is_mesh_body(*body)
                                       ? softbody::build_mesh_body(softbody::read_mesh_body(*body))
                                       : softbody::build_body(softbody::read_body(*body));
    if (out.surface.rows() == 0) body->fail("a body with a surface", "a curve");
    return out;
}

solve::IntegratorOptions steps_of(const softbody::SoftBody& body) {
    solve::IntegratorOptions options;
    options.method = solve::Method::kImplicitEuler;
    options.step_s = kStep_s;
    options.length_scale_m = body.length_scale_m;
    options.newton_iterations = 8;
    options.newton_tolerance = 1e-5;
    return options;
}

std::string error_message(const Json& id, const std::string& text) {
    return json_text(json_object({{"type", "error"}, {"id", id}, {"message", text}}));
}

Json point_json(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

int id_of_pull(const JsonCursor& message) { return message.at("pull").integer(0, 1000000); }

}  // namespace

BodySession::BodySession(const JsonCursor& experiment)
    : title_(experiment.at("title").string()),
      file_(experiment.file().filename().string()),
      body_(built(experiment)),
      steps_(solve::make_integrator(steps_of(body_))) {
    for (std::size_t i = 0; i < kHands; ++i) {
        free_.push_back(std::make_shared<tissue::InteractiveSpring>(track::kMinPull_n_per_m));
        body_.system.add(free_.back());
    }
    const Vec3 low = body_.rest.colwise().minCoeff().transpose(),
               high = body_.rest.colwise().maxCoeff().transpose();
    scale_ = kShown_m / (high - low).maxCoeff();
    centre_ = 0.5 * (low + high);
    scene_.rest = shown(body_.rest);
    render::Surface skin;
    skin.triangles = body_.surface;
    scene_.surfaces.push_back(std::move(skin));
    drawn_ = view::drawn_vertices(scene_);
    unit_m_ = view::unit_for(scene_.rest);
    restart();
}

Points BodySession::shown(const Points& points) const {
    Points out(points.rows(), 3);
    for (long i = 0; i < points.rows(); ++i)
        out.row(i) = shown(Vec3(points.row(i).transpose())).transpose();
    return out;
}

void BodySession::restart() {
    for (const auto& [id, hand] : hands_) let_go(hand);
    hands_.clear();
    state_ = body_.start();
    body_.system.place_fixed(state_.t_s, state_.x, state_.v);
    steps_->restart();
    quiet_ = 0;
}

std::string BodySession::welcome() const {
    const Json none = Json::array();
    return json_text(json_object({{"type", "welcome"},
                                  {"protocol", 1},
                                  {"kind", "body"},
                                  {"rig", title_},
                                  {"script", file_},
                                  {"quality", ""},
                                  {"channels", none},
                                  {"columns", none},
                                  {"expressions", none}}));
}

std::string BodySession::document() const {
    return json_text(json_object({{"type", "document"},
                                  {"script", json_object({{"duration_s", kDuration_s}})},
                                  {"revision", 0},
                                  {"dirty", false},
                                  {"undo", false},
                                  {"redo", false},
                                  {"duration_s", kDuration_s},
                                  {"curves", Json::object()},
                                  {"recorded", Json::object()}}));
}

std::string BodySession::scene() const {
    std::vector<char> soft(static_cast<std::size_t>(body_.rest.rows()), 1);
    for (const int node : body_.fixed) soft[static_cast<std::size_t>(node)] = 0;
    return view::encode_scene(scene_, drawn_, soft, unit_m_);
}

std::vector<std::string> BodySession::receive(const std::string& message) {
    Json id;
    try {
        const JsonCursor json = parse_json_text(message, "message");
        if (json.is_object() && json.json().contains("id")) id = json.json()["id"];
        const std::string type = json.at("type").string();
        if (type == "pull") {
            pull(json);
        } else if (type == "pull_to") {
            pull_to(json);
        } else if (type == "pull_end") {
            pull_end(json);
        } else if (type == "play" || type == "pause") {
            playing_ = type == "play";
        } else if (type == "seek") {
            (void)json.at("t_s").number({0, 0});
            restart();
        } else if (type != "sights" && type != "select") {
            json.at("type").fail("what can be done with a soft body: pull, play, pause, seek to 0");
        }
        quiet_ = 0;
    } catch (const Error& error) {
        return {error_message(id, error.what())};
    }
    return {};
}

void BodySession::pull(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull", "vertex", "point_m", "stiffness_n_per_m", "record"});
    const int id = id_of_pull(message);
    const int node = message.at("vertex").integer(0, static_cast<int>(body_.rest.rows()) - 1);
    if (std::find(body_.fixed.begin(), body_.fixed.end(), node) != body_.fixed.end())
        message.at("vertex").fail("a node that is not fixed");
    const double k =
        message.at("stiffness_n_per_m").number({track::kMinPull_n_per_m, track::kMaxPull_n_per_m});
    const Vec3 at = meant(message.at("point_m").vec3());
    if (const auto former = hands_.find(id); former != hands_.end()) {
        let_go(former->second);
        hands_.erase(former);
    }
    if (free_.empty())
        message.at("pull").fail("at most " + std::to_string(kHands) + " pulls at a time");
    Hand hand{node, k, at, state_.x.row(node).transpose(), free_.back()};
    free_.pop_back();
    const double critical = 2 * std::sqrt(k * body_.system.mass_kg()[node]);
    hand.spring->attach(solve::NodeBlend(node), at, k, critical);
    hands_.emplace(id, std::move(hand));
}

void BodySession::pull_to(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull", "point_m", "stiffness_n_per_m"});
    const auto found = hands_.find(id_of_pull(message));
    if (found == hands_.end()) return;  // it was let go of meanwhile
    Hand& hand = found->second;
    const Vec3 way = meant(message.at("point_m").vec3()) - hand.from;
    const double most_m = kFarthestPull * body_.length_scale_m;
    hand.at = hand.from + way * std::min(1.0, most_m / std::max(way.norm(), 1e-12));
    hand.spring->move(hand.at);
}

void BodySession::pull_end(const JsonCursor& message) {
    message.allow_keys({"type", "id", "pull"});
    const auto found = hands_.find(id_of_pull(message));
    if (found == hands_.end()) return;
    let_go(found->second);
    hands_.erase(found);
}

void BodySession::let_go(const Hand& hand) {
    hand.spring->release();
    free_.push_back(hand.spring);
}

bool BodySession::tick() {
    ++ticks_;
    if (!playing_ || quiet_ >= kQuietTicks) return false;
    const Points before = state_.x;
    const solve::IntegratorReport report =
        steps_->advance(body_.system, state_, state_.t_s + kStep_s);
    if (report.diverged || !state_.x.allFinite()) {
        events_.push_back(error_message(
            nullptr,
            "the simulation: expected finite positions, found none; the body begins again"));
        restart();
        return true;
    }
    const double most_m = (state_.x - before).rowwise().norm().maxCoeff();
    quiet_ = most_m < kStill * body_.length_scale_m ? quiet_ + 1 : 0;
    return true;
}

std::string BodySession::pose() const {
    view::PoseFrame frame;
    frame.step = static_cast<std::uint32_t>(ticks_);
    frame.t_s = state_.t_s;
    frame.vertices = drawn_.of(shown(state_.x));
    return view::encode_pose(frame, unit_m_);
}

std::string BodySession::state() const {
    Json pulls = Json::array();
    for (const auto& [id, hand] : hands_) {
        const Vec3 p = state_.x.row(hand.node).transpose();
        pulls.push_back(json_object({{"pull", id},
                                     {"vertex", hand.node},
                                     {"point_m", point_json(shown(p))},
                                     {"hand_m", point_json(shown(hand.at))},
                                     {"force_n", hand.stiffness_n_per_m * (hand.at - p).norm()},
                                     {"moved_mm", 1e3 * (p - hand.from).norm()},
                                     {"stiffness_n_per_m", hand.stiffness_n_per_m}}));
    }
    return json_text(json_object({{"type", "state"},
                                  {"tick", ticks_},
                                  {"t_s", state_.t_s},
                                  {"playing", playing_},
                                  {"recording", false},
                                  {"computing", false},
                                  {"computed_s", 0},
                                  {"resting", quiet_ >= kQuietTicks},
                                  {"dirty", false},
                                  {"overrides", Json::object()},
                                  {"pulls", pulls},
                                  {"selected", Json::object()}}));
}

}  // namespace risorius::specimen
