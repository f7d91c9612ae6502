// SPDX-License-Identifier: MIT
// Two sides of a face: how far they are from each other's mirror image, and the mean that is its own.
#include "risorius/blendshapes/detail/shape_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::blendshapes {
namespace {

TEST(MirroredShapes, TheMeanWithTheMirrorImageIsItsOwnMirrorImage) {
    geom::MirrorPairs mirror;
    mirror.partner = {1, 0, 2, -1};  // left, right, seam, no part of the surface
    Points leaning(4, 3);
    leaning << 1, 2, 3, -3, 2, 1, 0.5, 1, 1, 7, 7, 7;
    EXPECT_DOUBLE_EQ(asymmetry_m(mirror, leaning, leaning), std::sqrt(8.0));
    const Points mean = mean_with_mirror_image(mirror, leaning, leaning);
    EXPECT_EQ(asymmetry_m(mirror, mean, mean), 0.0);
    EXPECT_EQ(mean.row(0), Eigen::RowVector3d(2, 2, 2));
    EXPECT_EQ(mean.row(1), Eigen::RowVector3d(-2, 2, 2));
    EXPECT_EQ(mean.row(2), Eigen::RowVector3d(0, 1, 1));
    EXPECT_EQ(mean.row(3), leaning.row(3));
}

TEST(MirroredShapes, TwoSidesBecomeEachOthersMirrorImage) {
    geom::MirrorPairs mirror;
    mirror.partner = {1, 0};
    Points left(2, 3), right(2, 3);
    left << 4, 0, 0, 0, 1, 0;
    right << 0, 3, 0, -2, 0, 0;
    const Points one = mean_with_mirror_image(mirror, left, right);
    const Points other = with_mirror_image(mirror, right, one);
    EXPECT_EQ(asymmetry_m(mirror, one, other), 0.0);
    EXPECT_EQ(one.row(0), Eigen::RowVector3d(3, 0, 0));
    EXPECT_EQ(one.row(1), Eigen::RowVector3d(0, 2, 0));
}

}  // namespace
}  // namespace risorius::blendshapes
