// SPDX-License-Identifier: MIT
// What linear rigs are tried on: drawn at random, but the same every time, and like faces.
#include "risorius/blendshapes/detail/random_weights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paths.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {
namespace {

MadeShapes shapes_of(const std::string& set) {
    static const rig::RigDescription rig =
        rig::read_rig(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    MadeShapes out;
    for (const ShapeGoal& goal : shape_set(rig, set, {}, "rig", "only").goals)
        out.list.emplace_back().goal = goal;
    return out;
}

TEST(RandomFacsTrack, IsOneOfActionUnitsThatComeAndGo) {
    const MadeShapes shapes = shapes_of("facs");
    const auto index = [&](const std::string& name) {
        for (std::size_t i = 0; i < shapes.list.size(); ++i)
            if (shapes.list[i].goal.name == name) return static_cast<long>(i);
        throw std::out_of_range(name);
    };
    const std::vector<Eigen::VectorXd> track = random_facs_track(shapes, 400, 7);
    ASSERT_EQ(track.size(), 400u);
    double at_once = 0, alike = 0, sided = 0;
    Eigen::VectorXd max = Eigen::VectorXd::Zero(track[0].size());
    for (const Eigen::VectorXd& frame : track) {
        EXPECT_GE(frame.minCoeff(), 0);
        EXPECT_LE(frame.maxCoeff(), 1);
        max = max.cwiseMax(frame);
        // Degrees of one thing, and opposites
        EXPECT_LE(
            (frame[index("AU25")] > 0) + (frame[index("AU26")] > 0) + (frame[index("AU27")] > 0),
            1);
        EXPECT_FALSE(frame[index("AU5.l")] > 0 && frame[index("AU43.l")] > 0);
        for (std::size_t i = 0; i < shapes.list.size(); ++i) {
            const ShapeGoal& goal = shapes.list[i].goal;
            const double weight = frame[static_cast<long>(i)];
            if (goal.sides != Sides::kHalves) {
                at_once += weight > 0;
            } else if (goal.left) {
                const double other = frame[goal.partner];
                at_once += std::max(weight, other) > 0;
                sided += std::max(weight, other) > 0;
                alike += weight > 0 && weight == other;
            }
        }
    }
    EXPECT_NEAR(at_once / 400, 2.5, 0.5);
    EXPECT_NEAR(alike / sided, 0.8, 0.1);
    // All of them are there some time, and no descriptors of other actions
    for (const char* name : {"AU1.l", "AU12.r", "AU17.l", "AU27", "AU43.r"})
        EXPECT_GT(max[index(name)], 0.5) << name;
    for (const char* name : {"AU19", "AU34.l", "AU30.l", "AU61.l"})
        EXPECT_EQ(max[index(name)], 0) << name;
}

TEST(RandomFacsTrack, HangsOnItsSeedAlone) {
    const MadeShapes shapes = shapes_of("facs");
    EXPECT_EQ(random_facs_track(shapes, 20, 1), random_facs_track(shapes, 20, 1));
    EXPECT_NE(random_facs_track(shapes, 20, 1), random_facs_track(shapes, 20, 2));
    EXPECT_TRUE(random_facs_track(shapes_of("arkit52"), 20, 1).empty());
}

TEST(RandomWeights, KeepOpposedShapesApartAndWhatLiesOnAnotherWithIt) {
    const MadeShapes shapes = shapes_of("arkit52");
    for (const Eigen::VectorXd& frame : random_weights(shapes, 300, 3))
        for (std::size_t i = 0; i < shapes.list.size(); ++i) {
            const ShapeGoal& goal = shapes.list[i].goal;
            const double weight = frame[static_cast<long>(i)];
            if (goal.sides == Sides::kOpposed && weight > 0) {
                EXPECT_EQ(frame[goal.partner], 0) << goal.name;
            }
            if (goal.on_top_of >= 0) {
                EXPECT_GE(frame[goal.on_top_of], weight) << goal.name;
            }
        }
}

}  // namespace
}  // namespace risorius::blendshapes
