// SPDX-License-Identifier: MIT
// The warp through landmarks goes where it is told, and leaves alone what an affine map explains.
#include "risorius/rig/landmark_warp.h"

#include <gtest/gtest.h>

#include <random>

namespace risorius::rig {
namespace {

Points scattered(int count, unsigned seed, double size_m = 0.1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-size_m, size_m);
    Points out(count, 3);
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) out(i, k) = uniform(random);
    return out;
}

TEST(LandmarkWarp, WithoutSmoothingItMeetsEveryPairExactly) {
    const Points from = scattered(40, 1), to = from + scattered(40, 2, 0.01);
    const LandmarkWarp warp(from, to, 0.0);
    for (long i = 0; i < from.rows(); ++i)
        EXPECT_LT((warp(from.row(i).transpose()) - to.row(i).transpose()).norm(), 1e-10);
}

TEST(LandmarkWarp, SmoothingLetsPairsDisagreeALittle) {
    const Points from = scattered(40, 1), to = from + scattered(40, 2, 0.01);
    const LandmarkWarp warp(from, to, 1e-3);
    double worst = 0;
    for (long i = 0; i < from.rows(); ++i)
        worst = std::max(worst, (warp(from.row(i).transpose()) - to.row(i).transpose()).norm());
    EXPECT_GT(worst, 1e-6);
    EXPECT_LT(worst, 2e-3);
}

TEST(LandmarkWarp, AnAffineMapIsReproducedEverywhere) {
    Mat3 linear;
    linear << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.3;
    const Vec3 shift(0.02, -0.5, 3);
    const Points from = scattered(30, 3);
    Points to = from * linear.transpose();
    to.rowwise() += shift.transpose();
    const LandmarkWarp warp(from, to);
    const Points elsewhere = scattered(50, 4, 0.5);
    for (long i = 0; i < elsewhere.rows(); ++i) {
        const Vec3 p = elsewhere.row(i).transpose();
        EXPECT_LT((warp(p) - (linear * p + shift)).norm(), 1e-9);
    }
}

TEST(LandmarkWarp, OnePairMovedMovesItsNeighbourhoodMost) {
    const Points from = scattered(60, 5);
    Points to = from;
    to.row(0) += Vec3(0.01, 0, 0).transpose();
    const LandmarkWarp warp(from, to, 0.0);
    const Vec3 here = from.row(0).transpose();
    const auto shift = [&](const Vec3& p) { return (warp(p) - p).norm(); };
    EXPECT_GT(shift(here + Vec3(0.002, 0.002, 0)), 0.005);
    EXPECT_LT(shift(here + Vec3(0.5, 0.5, 0.5)), 0.005);
}

}  // namespace
}  // namespace risorius::rig
