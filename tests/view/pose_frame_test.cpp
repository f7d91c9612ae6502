// SPDX-License-Identifier: MIT
// What the page gets: positions within a hundredth of a millimetre, and nothing that is cut.
#include "risorius/view/pose_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "risorius/view/detail/pull_recorder.h"
#include "risorius/view/detail/take.h"

namespace risorius::view {
namespace {

PoseFrame some_pose(int vertices) {
    std::mt19937 random(3);
    const auto number = [&] { return (random() >> 8) * 0x1p-23 - 1; };
    PoseFrame pose;
    pose.step = 77;
    pose.t_s = 1.25;
    pose.head = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized());
    pose.head.translation() = Vec3(0.01, -0.02, 0.03);
    pose.mandible = Eigen::AngleAxisd(-0.2, Vec3::UnitX());
    pose.mandible.translation() = Vec3(0, -0.004, 0.006);
    pose.vertices.resize(vertices, 3);
    for (long i = 0; i < vertices; ++i)
        for (int k = 0; k < 3; ++k) pose.vertices(i, k) = 0.3 * number();
    pose.drive = Eigen::VectorXd::Constant(5, 0.25);
    pose.activation = Eigen::VectorXd::LinSpaced(5, -1, 1);
    return pose;
}

TEST(PoseFrame, IsExactToFiveMicrometres) {
    PoseFrame pose = some_pose(1000);
    pose.strain.assign(1000, 0.1);
    pose.strain[3] = std::numeric_limits<double>::quiet_NaN();
    pose.muscles = pose.vertices.topRows(10);
    const std::string bytes = encode_pose(pose, kFinestUnit_m);
    EXPECT_EQ(bytes.size(), 76u + 6000 + 10 + 1000 + 4 + 60);
    const PoseFrame back = decode_pose(bytes, kFinestUnit_m);
    EXPECT_LE((back.vertices - pose.vertices).cwiseAbs().maxCoeff(), 0.005e-3 + 1e-12);
    EXPECT_LE((back.muscles - pose.muscles).cwiseAbs().maxCoeff(), 0.005e-3 + 1e-12);
    EXPECT_EQ(back.step, 77u);
    EXPECT_EQ(back.t_s, 1.25);
    EXPECT_TRUE(back.head.isApprox(pose.head, 1e-6));
    EXPECT_TRUE(back.mandible.isApprox(pose.mandible, 1e-6));
    EXPECT_LE((back.activation - pose.activation).cwiseAbs().maxCoeff(), 0.5 / 127);
    EXPECT_NEAR(back.strain[0], 0.1, 0.2 / 127);
    EXPECT_TRUE(std::isnan(back.strain[3]));
}

TEST(PoseFrame, HasCoarserUnitsForAMeshThatIsTooLarge) {
    Points rest(1, 3);
    rest << 0.1, 0.2, -0.15;
    EXPECT_EQ(unit_for(rest), kFinestUnit_m);
    rest(0, 1) = 0.9;
    const double unit_m = unit_for(rest);
    EXPECT_GT(unit_m, kFinestUnit_m);
    PoseFrame pose = some_pose(1);
    pose.vertices = rest;
    EXPECT_LE((decode_pose(encode_pose(pose, unit_m), unit_m).vertices - rest).norm(), unit_m);
}

TEST(PoseFrame, RefusesWhatIsCut) {
    const std::string bytes = encode_pose(some_pose(20), kFinestUnit_m);
    for (const std::size_t size : {0u, 1u, 47u, 60u, 170u})
        EXPECT_THROW(decode_pose(bytes.substr(0, size), kFinestUnit_m), std::invalid_argument);
}

TEST(Take, KeepsPosesInTheirOrderOnly) {
    Take take;
    take.put(0, "a");
    take.put(2, "c");
    take.put(1, "b");
    EXPECT_EQ(take.valid(), 2);
    take.invalidate_from(1);
    EXPECT_TRUE(take.has(0));
    EXPECT_FALSE(take.has(1));
}

TEST(PullRecorder, LeavesOutWhatLiesOnAStraightLine) {
    std::vector<track::PullKey> keys;
    for (int i = 0; i <= 60; ++i) keys.push_back({i / 60.0, Vec3(i < 30 ? i / 10.0 : 3.0, 0, 0)});
    const auto kept = thinned(keys, kStraight_mm);
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_EQ(kept[1].time_s, 0.5);
}

}  // namespace
}  // namespace risorius::view
