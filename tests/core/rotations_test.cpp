// SPDX-License-Identifier: MIT
#include "risorius/core/rotations.h"

#include <gtest/gtest.h>

namespace risorius {
namespace {

Mat3 turned(double angle_rad, const Vec3& axis) {
    return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

TEST(Rotations, ShortestTurnBetweenDirections) {
    const Vec3 from(0.3, -2, 0.4), to(1, 0.5, -0.2);
    const Eigen::Quaterniond turn = turn_between(from, to);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-15);
    EXPECT_LT((turn.vec().cross(from.cross(to))).norm(), 1e-15);  // about the axis across both
    EXPECT_NEAR(turn.norm(), 1, 1e-15);
}

TEST(Rotations, OppositeDirectionsAreHalfATurnApart) {
    for (const Vec3& from : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ()), Vec3(1, -2, 3)}) {
        const Eigen::Quaterniond turn = turn_between(from, -2 * from);
        EXPECT_EQ(turn.w(), 0);
        EXPECT_LT((turn * from + from).norm(), 1e-14);
    }
}

TEST(Rotations, NearestRotationOfAStretchedOneIsItself) {
    const Mat3 rotation = turned(2.1, {1, -1, 0.5}), frame = turned(0.7, {0, 1, 1});
    const Mat3 stretch = frame * Vec3(3, 2, 0.5).asDiagonal() * frame.transpose();
    const NearestRotation nearest = nearest_rotation(rotation * stretch);
    EXPECT_LT((nearest.rotation - rotation).norm(), 1e-14);
    EXPECT_LT((nearest.stretch - Vec3(3, 2, 0.5)).norm(), 1e-14);
}

TEST(Rotations, AMirrorIsNoRotation) {
    const Mat3 matrix = turned(0.4, {1, 2, 3}) * Vec3(3, 2, -0.5).asDiagonal();
    const NearestRotation nearest = nearest_rotation(matrix);
    EXPECT_NEAR(nearest.rotation.determinant(), 1, 1e-14);
    EXPECT_NEAR(nearest.stretch.z(), -0.5, 1e-14);
    EXPECT_NEAR(nearest.stretch.sum(), (nearest.rotation.transpose() * matrix).trace(), 1e-14);
    // No rotation near it is nearer
    const double distance = (nearest.rotation - matrix).norm();
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, -1, 1)})
        for (const double angle : {-0.01, 0.01})
            EXPECT_LT(distance, (turned(angle, axis) * nearest.rotation - matrix).norm());
}

TEST(Rotations, NearestMotionIsFoundAgain) {
    Points from(5, 3);
    from << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 1, 1, -1;
    Rigid motion = Rigid::Identity();
    motion.linear() = turned(1.3, {0.2, 1, -0.4});
    motion.translation() = Vec3(0.5, -4, 2);
    const Points to =
        (from * motion.linear().transpose()).rowwise() + motion.translation().transpose();
    const Rigid found = nearest_motion(from, to);
    EXPECT_LT((found.matrix() - motion.matrix()).norm(), 1e-14);
}

}  // namespace
}  // namespace risorius
