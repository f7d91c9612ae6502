// SPDX-License-Identifier: MIT
// Blend shapes end softly, have two halves that make a whole, and say how they stretch.
#include "risorius/blendshapes/detail/sparse_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "risorius/blendshapes/detail/packed_shapes.h"
#include "risorius/blendshapes/detail/shape_measures.h"

namespace risorius::blendshapes {
namespace {

/// A row of vertices across the face, and a field that gets smaller to both sides.
Points row_of(long count) {
    Points out = Points::Zero(count, 3);
    for (long i = 0; i < count; ++i) out(i, 0) = 1e-3 * static_cast<double>(i - count / 2);
    return out;
}
Points bump(const Points& at, double centre_m, double height_m) {
    Points out = Points::Zero(at.rows(), 3);
    for (long v = 0; v < at.rows(); ++v)
        out(v, 1) = height_m * std::exp(-std::pow((at(v, 0) - centre_m) / 8e-3, 2));
    return out;
}

TEST(SparseShape, WhatHardlyMovesDoesNotMoveAtAllAndNothingJumps) {
    const Points at = row_of(101);
    const Points before = bump(at, 0, 3e-3);
    Points after = before;
    fade_out(after);
    const SparseShape shape = sparse(after);
    ASSERT_FALSE(shape.empty());
    EXPECT_LT(shape.vertex.size(), 60u);
    for (long v = 0; v < at.rows(); ++v) {
        const double was = before.row(v).norm(), is = after.row(v).norm();
        if (was <= 5e-5) {
            EXPECT_EQ(is, 0.0) << v;
        } else if (was >= 1.5e-4) {
            EXPECT_EQ(is, was) << v;
        } else {
            EXPECT_LE(is, was) << v;
        }
        EXPECT_LE(was - is, 7e-5) << v;
    }
    EXPECT_EQ(shape.dense(at.rows()), after);
    Points twice = at;
    shape.add_to(twice, 2.0);
    EXPECT_TRUE(twice.isApprox(at + 2 * after, 1e-14));
}

TEST(SparseShape, HalvesAddUpToTheWholeAndKeepToTheirSides) {
    const Points at = row_of(101);
    // Together they do more than each by itself
    const Points left_alone = bump(at, 10e-3, 2e-3), right_alone = bump(at, -10e-3, 2e-3);
    const Points whole = 1.3 * (left_alone + right_alone);
    Points left = left_alone, right = right_alone;
    share_the_rest(at, whole, 15e-3, left, right);
    EXPECT_LT((left + right - whole).cwiseAbs().maxCoeff(), 1e-17);
    for (long v = 0; v < at.rows(); ++v) {
        const long mirrored = at.rows() - 1 - v;
        EXPECT_NEAR(left(v, 1), right(mirrored, 1), 1e-17) << v;
        if (at(v, 0) < -15e-3) {
            EXPECT_EQ(left(v, 1), left_alone(v, 1)) << v;
        }
        // As smooth as what was shared
        if (v > 0) {
            EXPECT_LT(std::abs(left(v, 1) - left(v - 1, 1)), 0.4e-3) << v;
        }
    }
    EXPECT_EQ(left_fraction(-1, 15e-3), 0);
    EXPECT_EQ(left_fraction(0, 15e-3), 0.5);
    EXPECT_EQ(left_fraction(1, 15e-3), 1);
}

TEST(ShapeMeasures, StretchIsThatOfTheDeformationWhicheverWayItTurns) {
    Points rest(4, 3);
    rest << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 1, 3, 2;
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    Mat3 deform = Mat3::Identity();
    deform(0, 0) = 1.4;
    deform(1, 1) = 0.8;
    const Points moved = (turn * deform * rest.transpose()).transpose();
    const Stretch found = stretch_of(triangles, rest, moved);
    EXPECT_NEAR(found.max, 1.4, 1e-12);
    EXPECT_NEAR(found.min, 0.8, 1e-12);
    EXPECT_NEAR(found.max_of_99, 1.4, 1e-12);
    EXPECT_NEAR(stretch_of(triangles, rest, rest).max, 1, 1e-12);
}

TEST(PackedShapes, MovesVerticesAsTheLinearRigDoes) {
    const Points at = row_of(301);
    BlendShapeRig rig;
    for (const double centre_m : {-0.05, 0.0, 0.04}) {
        Points field = bump(at, centre_m, 5e-3);
        field.row(150).setZero();  // a gap
        fade_out(field);
        rig.shapes.push_back(sparse(field));
    }
    rig.drivers.push_back({"a*b", {0, 1}});
    rig.correctives.push_back({"c", rig.shapes[1], Eigen::VectorXd::Constant(1, -0.7)});
    const PackedShapes played(rig);
    for (const Eigen::Vector3d& weights :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 0.8, 0), Eigen::Vector3d(1, 1, 1)}) {
        Points wanted = at, got = at;
        rig.add_to(wanted, weights);
        played.add_to(got, rig.all_weights(weights));
        EXPECT_LT((wanted - got).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_EQ(weights.isZero(), got == at);
    }
}

}  // namespace
}  // namespace risorius::blendshapes
