// SPDX-License-Identifier: MIT
// Muscles as the standard table gives them, and their paths laid into a head.
#include "risorius/rig/muscle_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "heads.h"
#include "risorius/rig/muscle_path.h"

namespace risorius::rig {
namespace {

const Muscle& muscle_named(const std::string& id) {
    const std::vector<Muscle>& all = adult().rig.muscles.muscles;
    return *std::find_if(all.begin(), all.end(), [&](const Muscle& m) { return m.id == id; });
}

Json table_with(const std::function<void(Json&)>& change) {
    Json muscle = Json::parse(
        R"({"id": "m", "name": "M", "group": "jaw", "type": "linear", "paired": true, "width_mm": 28,
        "thickness_mm": 11, "F0_N": 190.4, "l0_mm": 27.8, "tendon_slack_mm": 24.2, "rest_norm_fibre_length": 0.9,
        "pennation_deg": 14, "max_shortening_frac": 0.45, "vmax_l0_per_s": 9, "t_act_ms": 30, "t_deact_ms": 60,
        "action": "closes", "paths": [[
          {"xyz_mm": [55, -16, 47], "body": "skull", "attach": "bone", "retarget": {"lm": ["zy_l"], "w": [1], "offset_mm": [1, 2, 3]}},
          {"xyz_mm": [45, -56, 21], "body": "mandible", "attach": "bone", "retarget": {"lm": ["go_l"], "w": [1], "offset_mm": [0, 0, 0]}}]]})");
    change(muscle);
    return Json{{"muscles", Json::array({muscle})}};
}

std::string message_of(const std::function<void(Json&)>& change) {
    try {
        read_muscle_table(JsonCursor::from_json(table_with(change), "muscles.json"));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(MuscleTable, GivesEveryNumberOfAHillTypeMuscle) {
    const Muscle& masseter = muscle_named("masseter_superficial");
    EXPECT_EQ(masseter.force_n, 190.4);
    EXPECT_DOUBLE_EQ(masseter.optimal_length_m, 27.8e-3);
    EXPECT_DOUBLE_EQ(masseter.tendon_slack_m, 24.2e-3);
    EXPECT_EQ(masseter.pennation_deg, 14);
    EXPECT_EQ(masseter.max_speed_hz, 9);
    EXPECT_EQ(masseter.rest_stretch, 0.9);
    ASSERT_EQ(masseter.paths.size(), 1u);
    EXPECT_EQ(masseter.paths[0].front().body, PathPoint::Body::kSkull);
    EXPECT_EQ(masseter.paths[0].back().body, PathPoint::Body::kMandible);
    EXPECT_FALSE(masseter.paths[0].front().on_skin());
}

TEST(MuscleTable, APathMirroredTwiceIsTheSame) {
    const MusclePath& path = muscle_named("zygomaticus_major").paths[0];
    const MusclePath other = mirrored(path), again = mirrored(other);
    EXPECT_EQ(other[0].atlas.x(), -path[0].atlas.x());
    EXPECT_TRUE(other[0].landmarks[0].first.ends_with("_r"));
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(again[i].atlas, path[i].atlas);
        EXPECT_EQ(again[i].landmarks, path[i].landmarks);
    }
}

// Masseter, 60 mm long in the atlas, scales with the head.
TEST(MusclePath, KeepsItsLengthRelativeToTheHead) {
    const MusclePath& path = muscle_named("masseter_superficial").paths[0];
    const Head& head = adult_placed();
    const double atlas = (path.back().atlas - path.front().atlas).norm();
    const Vec3 origin = place_on(head, path.front(), "masseter_superficial");
    const Vec3 insertion = place_on(head, path.back(), "masseter_superficial");
    EXPECT_NEAR((insertion - origin).norm() / (head.size * atlas), 1, 0.2);
    EXPECT_GT(origin.x(), 0);
    EXPECT_GT(origin.y(), insertion.y());
}

TEST(MusclePath, OfTheOtherSideIsItsMirrorOnASymmetricHead) {
    const MusclePath& path = muscle_named("temporalis_anterior").paths[0];
    const MusclePath other = mirrored(path);
    Head head;
    for (const auto& [id, weight] : path[0].landmarks) {
        head.landmarks[id] = Vec3(0.05, 0.01, 0.02);
        head.landmarks[mirrored_landmark(id)] = Vec3(-0.05, 0.01, 0.02);
    }
    const Vec3 left = place_on(head, path[0], "t"), right = place_on(head, other[0], "t");
    EXPECT_TRUE(right.isApprox(Vec3(-left.x(), left.y(), left.z()), 1e-14));
}

TEST(MusclePath, OnAHeadWithoutItsLandmarkIsRefused) {
    try {
        place_on(Head(), muscle_named("mentalis").paths[0][0], "mentalis");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "muscle mentalis: expected landmarks of the atlas in its paths, found \"sl\"");
    }
}

TEST(MuscleTable, ABundleNeedsNeitherPathNorLengthsButAJawMuscleDoes) {
    EXPECT_EQ(message_of([](Json& m) {
                  m["group"] = "mimetic";
                  for (const char* key : {"l0_mm", "width_mm", "paths"}) m.erase(key);
              }),
              "");
    EXPECT_EQ(message_of([](Json& m) { m.erase("l0_mm"); }),
              "muscles.json:/muscles/0: expected the key \"l0_mm\", found none");
    EXPECT_EQ(message_of([](Json& m) { m["paths"] = Json::array(); }),
              "muscles.json:/muscles/0/paths: expected at least one path, found []");
}

TEST(MuscleTable, WrongPathsAreRefusedAtTheirPlace) {
    EXPECT_EQ(message_of([](Json&) {}), "");
    EXPECT_EQ(message_of([](Json& m) { m["paths"][0].erase(1); }),
              "muscles.json:/muscles/0/paths/0: expected at least two points, found an array of 1");
    EXPECT_EQ(message_of([](Json& m) { m["paths"][0][1]["retarget"]["w"] = {0.5}; }),
              "muscles.json:/muscles/0/paths/0/1/retarget/w: expected weights that add up to 1, "
              "found [0.5]");
    EXPECT_EQ(message_of([](Json& m) { m["pennation_deg"] = 90; }),
              "muscles.json:/muscles/0/pennation_deg: expected [0, 89], found 90");
}

}  // namespace
}  // namespace risorius::rig
