// SPDX-License-Identifier: MIT
// Pulls of a script: when a hand holds the skin and where it is, and what is no pull.
#include "risorius/track/pull_track.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/track/timeline.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

ScriptDescription script_with(const char* pulls) {
    Json script = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 2})");
    script["pulls"] = Json::parse(pulls);
    return read_script(JsonCursor::from_json(script, "s.json"), tables().channels, tables().facs,
                       tables().expressions);
}

TEST(PullTrack, HoldsFromItsFirstKeyToItsLastAndMovesStraight) {
    const ScriptDescription script = script_with(
        R"([{"vertex": 7, "keys_mm": [[0.5, [0, 0, 0]], [1, [10, 0, -4]]]},
            {"vertex": 9, "stiffness_n_per_m": 500, "keys_mm": [[0, [1, 2, 3]], [2, [1, 2, 3]]]}])");
    const Timeline timeline(script, tables().channels);
    EXPECT_EQ(timeline.at(0.4).pulls.size(), 1u);
    EXPECT_EQ(timeline.at(1.1).pulls.size(), 1u);
    const std::vector<Pull> pulls = timeline.at(0.75).pulls;
    ASSERT_EQ(pulls.size(), 2u);
    EXPECT_EQ(pulls[0].vertex, 7);
    EXPECT_EQ(pulls[0].stiffness_n_per_m, 100);
    EXPECT_LT((pulls[0].offset_m - Vec3(5e-3, 0, -2e-3)).norm(), 1e-15);
    EXPECT_EQ(pulls[1].stiffness_n_per_m, 500);
    EXPECT_LT((pulls[1].offset_m - Vec3(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
    // Steps end at sixtieths, which files have in microseconds.
    EXPECT_EQ(pulls_at({{1, 100, {{0.016667, Vec3::Zero()}}}}, 1.0 / 60).size(), 1u);
}

TEST(PullTrack, SaysWhatIsNoPull) {
    const auto said = [](const char* pulls) { return message_of([&] { script_with(pulls); }); };
    EXPECT_EQ(said(R"([{"vertex": 1, "keys_mm": []}])"),
              "s.json:/pulls/0/keys_mm: expected at least one key [time_s, [x, y, z]], found []");
    EXPECT_EQ(said(R"([{"vertex": -1, "keys_mm": [[0, [0, 0, 0]]]}])").substr(0, 34),
              "s.json:/pulls/0/vertex: expected a");
    EXPECT_EQ(said(R"([{"vertex": 1, "keys_mm": [[1, [0, 0, 0]], [1, [0, 0, 0]]]}])"),
              "s.json:/pulls/0/keys_mm/1/0: expected a time after 1 s, found 1");
    EXPECT_EQ(said(R"([{"vertex": 1, "keys_mm": [[0, [0, 400, 0]]]}])"),
              "s.json:/pulls/0/keys_mm/0/1: expected an offset of at most 300 mm, found [0,400,0]");
    EXPECT_EQ(said(R"([{"vertex": 1, "stiffness_n_per_m": 0, "keys_mm": [[0, [0, 0, 0]]]}])"),
              "s.json:/pulls/0/stiffness_n_per_m: expected [1, 5000], found 0");
    EXPECT_EQ(said(R"([{"vertex": 1, "at": 2, "keys_mm": [[0, [0, 0, 0]]]}])").substr(0, 18),
              "s.json:/pulls/0/at");
}

}  // namespace
}  // namespace risorius::track
