// SPDX-License-Identifier: MIT
// What hands do to channels while time runs, as keys.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "face/adult_face.h"
#include "risorius/core/json_text.h"
#include "risorius/view/detail/channel_recorder.h"
#include "risorius/view/session.h"

namespace risorius::view {
namespace {

using track::Interpolation;

double largest_gap(const std::vector<track::Key>& samples, const std::vector<track::Key>& keys,
                   Interpolation way) {
    const track::Curve curve(keys, way);
    double gap = 0;
    for (const track::Key& one : samples)
        gap = std::max(gap, std::abs(curve.at(one.time_s) - one.value));
    return gap;
}

TEST(ChannelRecorder, KeepsEveryCurveWithinTheTolerance) {
    std::vector<track::Key> samples;
    for (int i = 0; i <= 240; ++i) {
        const double t_s = i / 60.0;
        samples.push_back({t_s, 0.5 + 0.3 * std::sin(3 * t_s) + 0.15 * std::sin(11 * t_s)});
    }
    for (const auto way : {Interpolation::kLinear, Interpolation::kSmooth, Interpolation::kStep}) {
        const auto keys = thinned_keys(samples, kThinned, way);
        EXPECT_LE(largest_gap(samples, keys, way), kThinned);
        EXPECT_LT(keys.size(), samples.size());
        EXPECT_EQ(keys.front().time_s, 0);
        EXPECT_EQ(keys.back().time_s, 4);
    }
    EXPECT_LT(thinned_keys(samples, kThinned, Interpolation::kSmooth).size(), 45u);
    // What is straight needs its ends alone.
    for (track::Key& one : samples) one.value = 0.1 * one.time_s;
    EXPECT_EQ(thinned_keys(samples, kThinned, Interpolation::kLinear).size(), 2u);
    EXPECT_EQ(thinned_to(1), 0.02);
    EXPECT_NEAR(thinned_to(150), 0.15, 1e-12);  // degrees of the head
}

Json plain_script() {
    return Json::parse(R"({"format": "risorius-script", "version": 1, "rig": "rig.json",
        "duration_s": 1, "channels": {"AU12": {"keys": [[0, 0.1], [0.5, 0.4], [0.98, 0.2]]}}})");
}

SessionInputs inputs_of(const Json& script) {
    auto files = std::make_shared<scene::RigFiles>();
    files->file = rig::adult_rig_file();
    files->rig = rig::adult().rig;
    files->mesh = rig::adult().mesh;
    return {files, JsonCursor::from_json(script, "script.json"), "draft",
            [files](const JsonCursor& json) {
                return track::read_script(json, files->rig.channels(), files->rig.facs,
                                          files->rig.expressions);
            }};
}

std::vector<Json> send(Session& session, const Json& json) {
    std::vector<Json> out;
    for (const std::string& one : session.receive(json_text(json))) out.push_back(Json::parse(one));
    return out;
}

Json script_of(const Session& session) { return Json::parse(session.document())["script"]; }

double t_of(const Session& session) { return Json::parse(session.state())["t_s"].get<double>(); }

void play_until(Session& session, double t_s) {
    for (int i = 0; i < 400 && t_of(session) < t_s - 1e-9; ++i) session.tick();
}

TEST(SessionRecording, MovedChannelsBecomeKeysThatAreUndoneAsOne) {
    Session session(inputs_of(plain_script()));
    send(session,
         {{"type", "override"}, {"channel", "AU4"}, {"value", 0.3}});  // before: not recorded
    send(session, {{"type", "record"}, {"on", true}});
    send(session, {{"type", "play"}});
    play_until(session, 0.2);
    std::vector<track::Key> done;
    while (t_of(session) < 0.7 - 1e-9) {
        const double value = 0.5 + 0.4 * std::sin(9 * t_of(session));
        send(session, {{"type", "override"}, {"channel", "AU12"}, {"value", value}});
        send(session, {{"type", "override"}, {"channel", "head_yaw_deg"}, {"value", 30 * value}});
        session.tick();
        done.push_back({t_of(session), value});
    }
    EXPECT_TRUE(Json::parse(session.state())["recording"].get<bool>());
    EXPECT_EQ(script_of(session), plain_script());  // nothing while it runs
    const auto replies = send(session, {{"type", "pause"}});
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0]["type"], "document");
    const Json state = Json::parse(session.state());
    EXPECT_FALSE(state["recording"].get<bool>());
    EXPECT_EQ(state["overrides"], (Json{{"AU4", 0.3}}));

    const Json channels = script_of(session)["channels"];
    EXPECT_EQ(channels.size(), 2u);
    const auto keys_of = [&](const char* name) {
        std::vector<track::Key> keys;
        for (const Json& key : channels[name]["keys"])
            keys.push_back({key[0].get<double>(), key[1].get<double>()});
        return keys;
    };
    const track::Curve before({{0, 0.1}, {0.5, 0.4}, {0.98, 0.2}}, Interpolation::kSmooth);
    const auto keys = keys_of("AU12");
    EXPECT_LT(keys.size(), 20u);
    EXPECT_LE(largest_gap(done, keys, Interpolation::kSmooth), kThinned + 1e-3);
    const track::Curve after(keys, Interpolation::kSmooth);
    for (const double t_s :
         {0.0, done.front().time_s - 1.0 / 60, done.back().time_s + 1.0 / 60, 0.98})
        EXPECT_NEAR(after.at(t_s), before.at(t_s), 2e-3) << t_s;
    EXPECT_EQ(channels["head_yaw_deg"]["interpolation"], "linear");
    for (track::Key& one : done) one.value *= 30;
    EXPECT_LE(largest_gap(done, keys_of("head_yaw_deg"), Interpolation::kLinear), 0.151);

    send(session, {{"type", "undo"}});
    EXPECT_EQ(script_of(session), plain_script());
    send(session, {{"type", "redo"}});
    EXPECT_EQ(script_of(session)["channels"], channels);
}

TEST(SessionRecording, ACameraOverridesItsChannelsAndIsRecorded) {
    Session session(inputs_of(plain_script()));
    const auto overrides = [&] { return Json::parse(session.state())["overrides"]; };
    const auto perform = [&](const Json& values) {
        return send(session, {{"type", "perform"}, {"values", values}});
    };
    send(session, {{"type", "override"}, {"channel", "AU9"}, {"value", 0.2}});
    perform({{"AU12.l", 0.5}, {"jaw_open", 0.1}});
    EXPECT_EQ(overrides(), (Json{{"AU12.l", 0.5}, {"AU9", 0.2}, {"jaw_open", 0.1}}));
    perform({{"AU12.l", 0.6}});
    EXPECT_EQ(overrides(), (Json{{"AU12.l", 0.6}, {"AU9", 0.2}}));
    // What is wrong changes nothing.
    EXPECT_EQ(perform({{"AU12.l", 7}})[0]["type"], "error");
    EXPECT_EQ(overrides(), (Json{{"AU12.l", 0.6}, {"AU9", 0.2}}));
    send(session, {{"type", "record"}, {"on", true}});
    send(session, {{"type", "play"}});
    while (t_of(session) < 0.5 - 1e-9) {
        perform({{"AU12.l", t_of(session)}});
        session.tick();
    }
    send(session, {{"type", "pause"}});
    perform(Json::object());
    EXPECT_EQ(overrides(), (Json{{"AU9", 0.2}}));
    const Json channels = script_of(session)["channels"];
    EXPECT_FALSE(channels.contains("AU9"));
    EXPECT_LE(channels["AU12.l"]["keys"].size(), 5u);  // a straight line, and how it ends
    send(session, {{"type", "undo"}});
    EXPECT_EQ(script_of(session), plain_script());
}

TEST(SessionRecording, PullsAndChannelsOfATakeAreOneStepThatTheEndMakes) {
    Session session(inputs_of(plain_script()));
    const int vertex = rig::adult().vertex("ch_l");
    const Vec3 p = session.drawn_scene().rest.row(vertex).transpose();
    send(session, {{"type", "record"}, {"on", true}});
    send(session, {{"type", "play"}});
    play_until(session, 0.1);
    send(session, {{"type", "override"}, {"channel", "AU1"}, {"value", 0.6}});
    send(session, {{"type", "pull"},
                   {"pull", 1},
                   {"vertex", vertex},
                   {"point_m", {p.x() + 8e-3, p.y(), p.z()}}});
    play_until(session, 0.3);
    send(session, {{"type", "pull_end"}, {"pull", 1}});
    EXPECT_FALSE(script_of(session).contains("pulls"));
    bool told = false;
    for (int i = 0; i < 200 && !told; ++i) {
        session.tick();
        for (const std::string& event : session.events())
            told = told || Json::parse(event)["type"] == "document";
    }
    EXPECT_TRUE(told);
    const Json script = script_of(session);
    ASSERT_EQ(script["pulls"].size(), 1u);
    EXPECT_NEAR(script["pulls"][0]["keys_mm"][0][0].get<double>(), 0.117, 0.002);
    EXPECT_NEAR(script["pulls"][0]["keys_mm"].back()[0].get<double>(), 0.3, 0.002);
    // Held to the end of the script
    EXPECT_EQ(script["channels"]["AU1"]["keys"].back(), Json::parse("[1.0, 0.6]"));
    EXPECT_TRUE(Json::parse(session.state())["overrides"].empty());
    send(session, {{"type", "undo"}});
    EXPECT_EQ(script_of(session), plain_script());
}

}  // namespace
}  // namespace risorius::view
