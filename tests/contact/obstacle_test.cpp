// SPDX-License-Identifier: MIT
#include "risorius/contact/obstacle.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "contact/shapes.h"
#include "force_term_checks.h"
#include "geom/test_surfaces.h"
#include "risorius/contact/distance_field.h"
#include "risorius/core/error.h"

namespace risorius::contact {
namespace {

/// Compares gradient and curvature of a gap with central differences.
void expect_derivatives(const Shape& shape, const Vec3& p, double tolerance) {
    const double h = 1e-5;  // the differences have an error of about 1e-9 of the gap's derivatives
    const Distance at = shape.distance(p);
    const Mat3 curvature = shape.curvature(p);
    for (int k = 0; k < 3; ++k) {
        const Distance above = shape.distance(p + h * Vec3::Unit(k));
        const Distance below = shape.distance(p - h * Vec3::Unit(k));
        EXPECT_NEAR(at.gradient(k), (above.gap_m - below.gap_m) / (2 * h), tolerance);
        const Vec3 column = (above.gradient - below.gradient) / (2 * h);
        EXPECT_LT((curvature.col(k) - column).norm(), 1e3 * tolerance) << p.transpose();
    }
}

TEST(Obstacle, SpheresAndCapsulesAreAsFarAsGeometrySays) {
    const auto sphere = make_sphere(0.5);
    EXPECT_NEAR(sphere->distance({0, 2, 0}).gap_m, 1.5, 1e-15);
    EXPECT_NEAR(sphere->distance({0.1, 0, 0}).gap_m, -0.4, 1e-15);
    EXPECT_NEAR(sphere->distance({0, 0, 0}).gap_m, -0.5, 1e-15);
    EXPECT_NEAR(sphere->distance({0, 0, 0}).gradient.norm(), 1, 1e-15);
    const auto capsule = make_capsule({0, 0, -1}, {0, 0, 1}, 0.25);
    EXPECT_NEAR(capsule->distance({1, 0, 0.7}).gap_m, 0.75, 1e-15);
    EXPECT_NEAR(capsule->distance({0, 0, 1.5}).gap_m, 0.25, 1e-15);
    EXPECT_NEAR(capsule->distance({0, 3, 5}).gap_m, 5 - 0.25, 1e-14);
    EXPECT_NEAR(make_plane()->distance({4, 5, -2}).gap_m, -2, 1e-15);
}

TEST(Obstacle, GradientsAndCurvaturesBelongToTheGap) {
    const Points places = testing_of::random_points(20, 1.5, 11);
    for (long i = 0; i < places.rows(); ++i) {
        const Vec3 p = places.row(i).transpose();
        expect_derivatives(*make_plane(), p, 1e-9);
        expect_derivatives(*make_sphere(0.5), p, 1e-9);
        expect_derivatives(*make_capsule({-0.4, 0.2, 0}, {0.5, -0.3, 0.1}, 0.3), p, 1e-9);
    }
}

TEST(Obstacle, AMovedShapeCarriesItsGapAlong) {
    Rigid from = Rigid::Identity();
    from.linear() = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
    Rigid to = from;
    to.linear() = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    to.translation() = Vec3(1, -2, 0.5);
    const auto capsule = make_capsule({0, 0, -1}, {0, 0, 1}, 0.25);
    const Vec3 in_shape(0.3, 0.4, 0.2);
    for (const RigidMotion& motion :
         {gliding(from, to, 1.0, 3.0), steady(from, {1, 2, 3}, {0.2, -0.4, 0.9})}) {
        const Obstacle obstacle(capsule, motion);
        for (const double t : {0.5, 1.7, 2.0, 2.9, 3.5}) {
            const PlacedShape placed = obstacle.at(t);
            const Vec3 p = placed.place() * in_shape;
            EXPECT_NEAR(placed.distance(p).gap_m, capsule->distance(in_shape).gap_m, 1e-14);
            // The velocity of its material is the rate at which its points move.
            const double h = 1e-6;
            const Vec3 rate =
                (obstacle.at(t + h).place() * in_shape - obstacle.at(t - h).place() * in_shape) /
                (2 * h);
            EXPECT_LT((placed.velocity(p) - rate).norm(), 1e-8) << "t = " << t;
        }
    }
}

TEST(Obstacle, APlaneCanBePutThroughAnyPointWithAnyNormal) {
    for (const Vec3& normal : {Vec3(0.6, 0, 0.8), Vec3(0, 0, -1)}) {
        const Obstacle obstacle(make_plane(), plane_place({1, 2, 3}, normal));
        const Distance distance = obstacle.at(0).distance(Vec3(1, 2, 3) + 0.5 * normal);
        EXPECT_NEAR(distance.gap_m, 0.5, 1e-14);
        EXPECT_LT((distance.gradient - normal).norm(), 1e-14);
    }
}

TEST(Obstacle, ASphereWithoutSizeIsRefused) {
    try {
        make_sphere(-0.1, "scene.json:/obstacles/1");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "scene.json:/obstacles/1/radius_m: expected (0, inf), found -0.1");
    }
}

TEST(DistanceField, OfASphereMeshIsNearTheExactSphere) {
    const auto mesh = geom::testing::sphere(40, 80, 0.5);
    const DistanceField field(mesh.positions, mesh.triangles);
    // The mesh itself is up to r (1 - cos(pi / 80)^2) = 0.8 mm inside the sphere; the field adds less than 0.1 mm.
    const double mesh_error = 0.5 * (1 - std::pow(std::cos(std::numbers::pi / 80), 2));
    const Points directions = testing_of::random_points(200, 1.0, 5);
    for (long i = 0; i < directions.rows(); ++i) {
        const Vec3 n = directions.row(i).transpose().normalized();
        for (const double r : {0.35, 0.48, 0.5, 0.52}) {
            const Distance distance = field.distance(r * n);
            EXPECT_GT(distance.gap_m, r - 0.5 - 1e-4);
            EXPECT_LT(distance.gap_m, r - 0.5 + mesh_error + 1e-4);
            EXPECT_LT((distance.gradient - n).norm(), 0.05) << "at " << (r * n).transpose();
        }
    }
}

TEST(DistanceField, GradientAndCurvatureBelongToTheGapInTheGrid) {
    const auto mesh = testing::box({-0.5, -0.4, -0.3}, {1, 0.8, 0.6}, 1);
    const DistanceField field(mesh.positions, mesh.triangles, {.cells = 12});
    const Points places = testing_of::random_points(40, 0.49, 7);
    for (long i = 0; i < places.rows(); ++i)
        expect_derivatives(field, places.row(i).transpose(), 1e-8);
}

TEST(DistanceField, IsNegativeInsideAndPositiveOutsideUpToEdgesAndCorners) {
    const auto mesh = testing::box({-0.5, -0.4, -0.3}, {1, 0.8, 0.6}, 1);
    const DistanceField field(mesh.positions, mesh.triangles, {.cells = 40});
    const double near = 0.3 * field.spacing_m();  // sharp edges are rounded by less
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0}) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Vec3 on = Vec3(0.5 * x, 0.4 * y, 0.3 * z), out = Vec3(x, y, z);
                EXPECT_GT(field.distance(on + near * out).gap_m, 0) << on.transpose();
                EXPECT_LT(field.distance(on - near * out).gap_m, 0) << on.transpose();
                EXPECT_NEAR(field.distance(on).gap_m, 0, 0.2 * field.spacing_m());
            }
    EXPECT_NEAR(field.distance({0, 0, 0.1}).gap_m, -0.2, 1e-6);
    EXPECT_NEAR(field.distance({0, 0, 0.32}).gap_m, 0.02, 1e-6);
    EXPECT_GT(field.distance({5, 5, 5}).gap_m, 1.0) << "far outside the grid";
}

std::string message_of(const Points& positions, const Triangles& triangles) {
    try {
        make_mesh(positions, triangles, {}, "rock.obj");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(DistanceField, RefusesWhatIsNoClosedSurface) {
    const auto mesh = testing::box({0, 0, 0}, {1, 1, 1}, 1);
    const Triangles& all = mesh.triangles;
    EXPECT_EQ(message_of(mesh.positions, all), "accepted");
    EXPECT_EQ(
        message_of(mesh.positions, all.topRows(11)),
        "rock.obj/edge 2-3: expected two triangles (a closed surface), found 1 at (0, 1, 1) m");
    Triangles doubled(13, 3);
    doubled << all, all.row(0);
    EXPECT_EQ(
        message_of(mesh.positions, doubled),
        "rock.obj/edge 0-1: expected two triangles (a closed surface), found 3 at (0, 0, 0) m");
    Triangles flipped = all;
    std::swap(flipped(3, 0), flipped(3, 1));
    EXPECT_EQ(message_of(mesh.positions, flipped),
              "rock.obj/edge 4-6: expected triangles that run along it in opposite ways, found a "
              "flipped one at (1, 0, 0) m");
    Triangles inside_out = all;
    inside_out.col(0).swap(inside_out.col(1));
    EXPECT_EQ(message_of(mesh.positions, inside_out),
              "rock.obj: expected a surface that faces outwards, of volume > 0, found -1 m3");
    EXPECT_EQ(message_of(mesh.positions, Triangles(0, 3)),
              "rock.obj: expected a closed surface, found no triangles");
}

}  // namespace
}  // namespace risorius::contact
