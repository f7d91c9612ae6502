// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "risorius/landmarks/detail/face_points.h"
#include "risorius/landmarks/detail/smooth_field.h"
#include "risorius/landmarks/similarity.h"

namespace risorius::landmarks {
namespace {

TEST(LiftedPoints, OneViewThatIsWrongDoesNotMoveThePoint) {
    std::vector<Sighting> views(8, {Vec3(1, 2, 3), 1.0});
    views.push_back({Vec3(9, 2, 3), 1.0});
    const SeenPoint point = median_point(views);
    // The median of collinear points is the majority's; their mean would be 0.9 away.
    EXPECT_NEAR((point.at - Vec3(1, 2, 3)).norm(), 0, 1e-2);
    EXPECT_NEAR(point.spread, 8.0 / 9, 2e-2);
}

TEST(LiftedPoints, ViewsThatSeeNothingSayNothing) {
    EXPECT_EQ(median_point({{Vec3(5, 5, 5), 0}, {Vec3(1, 0, 0), 0}}).weight, 0);
    EXPECT_NEAR((median_point({{Vec3(5, 5, 5), 0}, {Vec3(1, 0, 0), 2}}).at - Vec3(1, 0, 0)).norm(),
                0, 1e-9);
}

TEST(LiftedPoints, APictureShowsAPointWhereItsRayGoes) {
    ViewFrame frame;
    frame.centre = Vec3(1, -2, 3);
    frame.axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    frame.width = 0.4;
    for (const Vec2& px : {Vec2(96, 96), Vec2(10, 150), Vec2(180.5, 3)}) {
        const Vec3 plane = frame.on_plane(px);
        EXPECT_NEAR((frame.in_picture(plane) - px).norm(), 0, 1e-9);
        const Vec3 nearer = plane + 0.3 * (frame.viewer() - plane);
        EXPECT_NEAR((frame.in_picture(nearer) - px).norm(), 0, 1e-9);
    }
}

TEST(LandmarkSimilarity, FindsAMotionAndItsInverse) {
    Similarity motion;
    motion.scale = 250;
    motion.rotation = Eigen::AngleAxisd(2.1, Vec3(3, -1, 2).normalized()).toRotationMatrix();
    motion.shift = Vec3(10, -20, 5);
    const std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
    std::vector<Vec3> to;
    for (const Vec3& p : from) to.push_back(motion(p));
    to.back() += Vec3(40, 0, 0);  // a point without weight
    const Similarity found = nearest_similarity(from, to, {1, 2, 1, 3, 0});
    EXPECT_NEAR(found.scale, 250, 1e-9);
    EXPECT_NEAR((found.rotation - motion.rotation).norm(), 0, 1e-12);
    EXPECT_NEAR((found.inverse()(motion(Vec3(0.3, 4, -2))) - Vec3(0.3, 4, -2)).norm(), 0, 1e-9);
}

TEST(SmoothField, GoesThroughCertainPointsAndFadesFarAway) {
    Points x(3, 3), d(3, 3);
    x << 0, 0, 0, 0.03, 0, 0, 0, 0.04, 0;
    d << 0.005, 0, 0, 0, 0.003, 0, 0, 0, -0.002;
    SmoothField field(x, {1e-6, 1e-6, 1e-6});
    field.set(d);
    for (Eigen::Index i = 0; i < 3; ++i) {
        EXPECT_NEAR((field.at(x.row(i).transpose()) - d.row(i).transpose()).norm(), 0, 1e-7);
        EXPECT_NEAR((field.at(x.row(i).transpose()) - field.at_point(i)).norm(), 0, 1e-12);
        EXPECT_LT(field.deviation_at(x.row(i).transpose()), 1e-5);
    }
    EXPECT_LT(field.at(Vec3(3, 0, 0)).norm(), 1e-9);
    // Far away nothing is known: sqrt(10^2 + 3^2) mm
    EXPECT_NEAR(field.deviation_at(Vec3(3, 0, 0)), std::hypot(0.010, 0.003), 1e-9);
}

TEST(SmoothField, TwoEquallyUncertainPointsInOnePlaceGiveTheirMean) {
    Points x(2, 3), d(2, 3);
    x.setZero();
    d << 0.004, 0, 0, 0.002, 0, 0;
    SmoothField field(x, {1e-4, 1e-4});
    field.set(d);
    EXPECT_NEAR(field.at(Vec3::Zero()).x(), 0.003, 1e-6);
}

}  // namespace
}  // namespace risorius::landmarks
