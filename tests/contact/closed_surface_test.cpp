// SPDX-License-Identifier: MIT
#include "risorius/contact/detail/closed_surface.h"

#include <gtest/gtest.h>

#include "contact/shapes.h"
#include "force_term_checks.h"
#include "geom/test_surfaces.h"

namespace risorius::contact {
namespace {

TEST(ClosedSurface, KnowsTheDistanceToABoxFromEverySide) {
    const Vec3 half(0.5, 0.4, 0.3);
    const auto mesh = testing::box(-half, 2 * half, 2);
    const ClosedSurface surface(mesh.positions, mesh.triangles);
    const Points places = testing_of::random_points(500, 0.8, 21);
    for (long i = 0; i < places.rows(); ++i) {
        const Vec3 p = places.row(i).transpose();
        const Vec3 beyond = p.cwiseAbs() - half;
        const double exact = beyond.maxCoeff() < 0 ? beyond.maxCoeff() : beyond.cwiseMax(0).norm();
        EXPECT_NEAR(surface.nearest(p)->gap_m, exact, 1e-14) << p.transpose();
    }
}

TEST(ClosedSurface, KeepsTheSignAtASharpSpikeWhereFaceNormalsDisagree) {
    // A thin spike. Seen from beyond its tip, single faces would say inside.
    Points positions(4, 3);
    positions << 0.1, 0, 0, -0.05, 0.08, 0, -0.05, -0.08, 0, 0.4, 0, 1;
    Triangles triangles(4, 3);
    triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    const ClosedSurface surface(positions, triangles);
    const Points turns = testing_of::random_points(300, 0.05, 3);
    for (long i = 0; i < turns.rows(); ++i) {
        const Vec3 off = turns.row(i).transpose();
        const Vec3 tip = positions.row(3).transpose();
        const auto nearest = surface.nearest(tip + off);
        if ((nearest->point - tip).norm() < 1e-12) {
            EXPECT_GT(nearest->gap_m, 0) << off.transpose();
        }
    }
    EXPECT_LT(surface.nearest({0.02, 0, 0.1})->gap_m, 0);
}

TEST(ClosedSurface, MovesWithItsNodes) {
    const auto mesh = geom::testing::sphere(10, 20, 0.5);
    ClosedSurface surface(mesh.positions, mesh.triangles);
    Rigid motion = Rigid::Identity();
    motion.linear() = Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()).toRotationMatrix();
    motion.translation() = Vec3(3, 0, -1);
    const double before = surface.nearest({0.1, 0.2, 0.6})->gap_m;
    Points moved = mesh.positions;
    for (long i = 0; i < moved.rows(); ++i)
        moved.row(i) = (motion * Vec3(moved.row(i).transpose())).transpose();
    surface.refit(moved);
    EXPECT_NEAR(surface.nearest(motion * Vec3(0.1, 0.2, 0.6))->gap_m, before, 1e-13);
    EXPECT_FALSE(surface.nearest({0, 0, 0}, 0.5));
}

}  // namespace
}  // namespace risorius::contact
