// SPDX-License-Identifier: MIT
#include "risorius/fitting/landmark_file.h"

#include <gtest/gtest.h>

#include "message_of.h"
#include "risorius/rig/head.h"

namespace risorius::fitting {
namespace {

TEST(LandmarkConfidence, UnsureLandmarksAreLeftToTheAtlas) {
    std::map<std::string, rig::Landmark> landmarks;
    landmarks["prn"] = {.vertex = 3, .confidence = 0.5};
    landmarks["op"] = {.vertex = 4, .confidence = 0.49};
    landmarks["go_l"] = {.vertex = 5, .confidence = 0};
    landmarks["zy_l"] = {.vertex = 6};
    EXPECT_EQ(
        leave_out_unsure(landmarks, "landmarks.json"),
        std::vector<std::string>{"landmarks of little confidence are left to the atlas: go_l op"});
    EXPECT_EQ(landmarks.size(), 2u);
    EXPECT_EQ(landmarks.count("prn") + landmarks.count("zy_l"), 2u);
    EXPECT_TRUE(leave_out_unsure(landmarks, "landmarks.json").empty());
}

TEST(LandmarkConfidence, NoneOfTheTwentyIsLeftOut) {
    for (const std::string& id : rig::required_landmarks()) {
        std::map<std::string, rig::Landmark> landmarks;
        landmarks[id] = {.vertex = 3, .confidence = 0.2};
        EXPECT_EQ(message_of([&] { leave_out_unsure(landmarks, "a.json"); }),
                  "a.json:/landmarks/" + id +
                      "/confidence: expected at least 0.5 for a landmark that a rig needs (correct "
                      "it, and take the key out), found 0.2");
    }
}

}  // namespace
}  // namespace risorius::fitting
