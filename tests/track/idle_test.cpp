// SPDX-License-Identifier: MIT
// An idle face blinks, looks around and sways as people do, and does so in the same way for the same seed.
#include "risorius/track/detail/idle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

ScriptDescription idle_script(const std::string& events, int seed = 1, double duration_s = 60) {
    Json json = Json::parse(R"({"format": "risorius-script", "version": 1, "rig": "rig.json"})");
    json["duration_s"] = duration_s;
    json["seed"] = seed;
    json["events"] = Json::parse(events);
    return read_script(JsonCursor::from_json(json, "script.json"), tables().channels, tables().facs,
                       tables().expressions);
}

std::string idle_error(const std::string& events) {
    try {
        idle_script(events);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Idle, BlinksComeAtTheRateAskedForWithARightSkewedSpread) {
    const auto blinks = idle_blinks({.start_s = 0, .end_s = 36000, .options = {}});
    const double per_minute = static_cast<double>(blinks.size()) / 600;
    EXPECT_NEAR(per_minute, 17, 0.5);
    double squares = 0, below = 0;
    const double mean = 60.0 / 17;
    for (std::size_t i = 1; i < blinks.size(); ++i) {
        const double apart = blinks[i].start_s - blinks[i - 1].start_s;
        EXPECT_GE(apart, 0.3 - 1e-9);
        squares += (apart - mean) * (apart - mean);
        below += apart < mean;
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(blinks.size())) / mean, 0.6, 0.05);
    EXPECT_GT(below / static_cast<double>(blinks.size()), 0.55) << "the median lies below the mean";
}

TEST(Idle, SaccadesFollowTheMainSequenceAndStayWithinReach) {
    const IdleMotion motion({.start_s = 1, .end_s = 301, .options = {}});
    const auto& saccades = motion.saccades();
    EXPECT_NEAR(static_cast<double>(saccades.size()) / 300, 1 / 0.43, 0.3) << "a second";
    for (std::size_t i = 0; i < saccades.size(); ++i) {
        const IdleSaccade& s = saccades[i];
        EXPECT_NEAR(s.duration_s, 0.022 + 0.0023 * (s.to_deg - s.from_deg).norm(), 1e-12);
        EXPECT_LE(s.to_deg.norm(), 2.0);
        if (i == 0 || i + 1 == saccades.size()) continue;
        const double rested = s.start_s - saccades[i - 1].start_s - saccades[i - 1].duration_s;
        EXPECT_GE(rested, 0.2 - 1e-9);
        EXPECT_LE(rested, 0.6 + 1e-9);
    }
    const KinematicValues end = motion.at(301);
    for (const double value : end) EXPECT_NEAR(value, 0, 1e-9);
}

TEST(Idle, TheHeadSwaysByLessThanADegreeAndSlowly) {
    const IdleMotion motion({.start_s = 0, .end_s = 600, .options = {.breaths_per_minute = 0}});
    double squares = 0, fastest = 0, before = 0;
    int count = 0;
    for (double t = 10; t < 590; t += 0.05) {
        const double yaw = motion.at(t)[static_cast<std::size_t>(Kinematic::kHeadYaw)];
        squares += yaw * yaw;
        if (count++ > 0) fastest = std::max(fastest, std::abs(yaw - before) / 0.05);
        before = yaw;
    }
    EXPECT_NEAR(std::sqrt(squares / count), 0.8, 0.15) << "deg";
    EXPECT_LT(fastest, 15) << "deg/s";
}

TEST(Idle, TheSameSeedGivesTheSameFaceAndAnotherAnother) {
    const auto drive = [](int seed) {
        const ScriptDescription script = idle_script(R"([{"idle": {}}])", seed);
        return std::pair{Timeline(script, tables().channels).at(20.3).kinematic, script.blinks};
    };
    EXPECT_EQ(drive(5).first, drive(5).first);
    EXPECT_NE(drive(5).first, drive(6).first);
    EXPECT_EQ(drive(5).second.size(), drive(5).second.size());
    EXPECT_NE(drive(5).second.front().start_s, drive(6).second.front().start_s);
}

TEST(Idle, BothEyesTurnAlikeAndWhatAScriptWritesIsAdded) {
    const ScriptDescription script =
        idle_script(R"([{"idle": {"sway": 0}, "start_s": 2, "end_s": 40}])");
    const Timeline timeline(script, tables().channels);
    EXPECT_EQ(timeline.at(1.9).at(Kinematic::kGazeYawLeft), 0);
    EXPECT_EQ(timeline.at(41).at(Kinematic::kHeadUp), 0);
    bool moved = false;
    for (double t = 2; t < 40; t += 0.31) {
        const Drive drive = timeline.at(t);
        EXPECT_EQ(drive.at(Kinematic::kGazeYawLeft), drive.at(Kinematic::kGazeYawRight));
        EXPECT_EQ(drive.at(Kinematic::kHeadYaw), 0);
        moved = moved || drive.at(Kinematic::kGazeYawLeft) != 0;
    }
    EXPECT_TRUE(moved);
}

TEST(Idle, AWrittenBlinkIsNotDoubled) {
    const auto idle = idle_script(R"([{"idle": {}}])").blinks;
    ASSERT_GT(idle.size(), 5u);
    const std::string at = std::to_string(idle[2].start_s + 0.2);
    const auto both = idle_script(R"([{"idle": {}}, {"blink": {}, "start_s": )" + at + "}]").blinks;
    EXPECT_EQ(both.size(), idle.size());
}

TEST(Idle, MistakesAreNamed) {
    EXPECT_EQ(idle_error(R"([{"idle": {"blink_per_minute": 9}}])"),
              "script.json:/events/0/idle/blink_per_minute: expected a known key (did you mean "
              "\"blinks_per_minute\"?), found unknown key \"blink_per_minute\"");
    EXPECT_EQ(idle_error(R"([{"idle": {}, "end_s": 3, "duration_s": 3}])"),
              "script.json:/events/0: expected either \"end_s\" or \"duration_s\", found both");
    EXPECT_EQ(idle_error(R"([{"idle": {}, "blink": {}, "start_s": 1}])"),
              "script.json:/events/0: expected an event with one of \"expression\", \"blink\", "
              "\"idle\" and \"say\", found two");
    EXPECT_EQ(idle_error(R"([{"idle": {"sway": -1}}])"),
              "script.json:/events/0/idle/sway: expected [0, 5], found -1");
}

}  // namespace
}  // namespace risorius::track
