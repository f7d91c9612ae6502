// SPDX-License-Identifier: MIT
#include "risorius/contact/obstacle_contact.h"

#include <gtest/gtest.h>

#include <limits>

#include "contact/shapes.h"
#include "force_term_checks.h"
#include "risorius/contact/distance_field.h"

namespace risorius::contact {
namespace {

using namespace testing_of;

const ContactMaterial kRough{.stiffness_pa_per_m = 2e4,
                             .thickness_m = 0.05,
                             .friction = 0.6,
                             .slip_speed_m_per_s = 0.05,
                             .damping_s = 0.02};

/// A box whose samples lie in and around the contact layer of every obstacle.
struct Scene {
    testing::Surface body = testing::box({-0.3, -0.2, -0.02}, {0.6, 0.5, 0.3}, 1);
    std::vector<ContactSample> samples = surface_samples(body.positions, body.triangles, 3);
    Points start = body.positions + random_points(8, 0.03, 2);
    Points x = start + random_points(8, 0.01, 8);
    Points v = random_points(8, 0.1, 13);
};

std::vector<std::shared_ptr<const Obstacle>> obstacles() {
    const auto rock = testing::box({-0.2, -0.2, -0.6}, {0.5, 0.4, 0.6}, 1);
    Rigid below = Rigid::Identity();
    below.translation() = Vec3(0.02, 0.03, -0.28);
    return {std::make_shared<Obstacle>(make_plane(),
                                       plane_place({0, 0, 0}, Vec3(0.1, 0, 1).normalized())),
            std::make_shared<Obstacle>(make_sphere(0.3), steady(below, {0.1, 0.3, 0}, {0, 0.2, 1})),
            std::make_shared<Obstacle>(make_capsule({-0.2, 0, 0}, {0.2, 0.1, 0}, 0.3), below),
            std::make_shared<Obstacle>(make_mesh(rock.positions, rock.triangles, {.cells = 10}))};
}

TEST(ObstacleContact, ForceIsMinusTheSlopeOfTheEnergy) {
    const Scene scene;
    const ContactMaterial smooth{.stiffness_pa_per_m = 2e4, .thickness_m = 0.05};
    for (const auto& obstacle : obstacles())
        expect_force_is_minus_slope_of_energy(ObstacleContact(scene.samples, obstacle, smooth), 0.1,
                                              scene.x, 1e-6, 1e-7);
}

TEST(ObstacleContact, GradientAndHessianBelongToThePotentialOfAStepWithFrictionAndDamping) {
    const Scene scene;
    for (const auto& obstacle : obstacles()) {
        ObstacleContact contact(scene.samples, obstacle, kRough);
        contact.begin_step(0.1, 0.1, scene.start, scene.v);
        const solve::ImplicitStep step{0.2, 0.1, scene.start};
        expect_gradient_of_potential(contact, step, scene.x, 1e-6, 1e-7);
        // Differences across the kink of the damper and the jump of the penalty's third derivative: 1e-6.
        expect_hessian_of_potential(contact, step, scene.x, 1e-6, 2e-5);
        expect_projection(contact, step, scene.x);
    }
}

TEST(ObstacleContact, AnEquilibriumHasNeitherFrictionNorDamping) {
    const Scene scene;
    const double forever = std::numeric_limits<double>::infinity();
    for (const auto& obstacle : obstacles()) {
        ObstacleContact contact(scene.samples, obstacle, kRough);
        contact.begin_step(0.1, forever, scene.start, scene.v);
        Points gradient = Points::Zero(8, 3);
        EXPECT_EQ(contact.add_potential({0.1, forever, scene.start}, scene.x, gradient),
                  contact.energy(0.1, scene.x));
    }
}

TEST(ObstacleContact, FrictionOpposesSlipAgainstTheObstaclesOwnMotion) {
    const auto belt =
        std::make_shared<Obstacle>(make_plane(), steady(Rigid::Identity(), {1, 0, 0}));
    const ContactMaterial material{
        .stiffness_pa_per_m = 100, .thickness_m = 0.1, .friction = 0.5, .slip_speed_m_per_s = 0.01};
    ObstacleContact contact(node_samples({0}), belt, material);
    Points x(1, 3), v = Points::Zero(1, 3), force = Points::Zero(1, 3);
    x << 0, 0, -0.05;  // pressure 100 (0.05 + 0.05) N
    contact.add_force(0, x, v, force);
    EXPECT_NEAR(force(0, 2), 10, 1e-12);
    EXPECT_NEAR(force(0, 0), 5, 1e-12) << "dragged along";
    v << 1, 0, 0;
    force.setZero();
    contact.add_force(0, x, v, force);
    EXPECT_NEAR(force(0, 0), 0, 1e-12) << "carried without slip";
    // The same in an implicit step: standing still means slipping back by 1 m/s times h.
    contact.begin_step(0, 0.1, x, v);
    EXPECT_NEAR(potential_gradient(contact, {0.1, 0.1, x}, x)(0, 0), -5, 1e-12);
    Points carried = x;
    carried(0, 0) += 0.1;
    EXPECT_NEAR(potential_gradient(contact, {0.1, 0.1, x}, carried)(0, 0), 0, 1e-12);
}

TEST(ObstacleContact, DampingResistsApproachOnly) {
    const auto floor = std::make_shared<Obstacle>(make_plane());
    const ContactMaterial material{.stiffness_pa_per_m = 100, .thickness_m = 0.1, .damping_s = 0.2};
    const ContactMaterial undamped{.stiffness_pa_per_m = 100, .thickness_m = 0.1};
    const ObstacleContact contact(node_samples({0}), floor, material);
    const ObstacleContact plain(node_samples({0}), floor, undamped);
    Points x(1, 3), v(1, 3);
    x << 0, 0, -0.05;
    v << 0, 0, -0.3;
    EXPECT_NEAR(contact.total_force(0, x, v).z() - plain.total_force(0, x, v).z(), 100 * 0.2 * 0.3,
                1e-12);
    v << 0, 0, 0.3;
    EXPECT_EQ(contact.total_force(0, x, v), plain.total_force(0, x, v));
}

TEST(ObstacleContact, ASmallSphereUnderACoarseFaceIsFeltBetweenTheNodes) {
    const auto body = testing::box({-1.5, -1.5, 0}, {3, 3, 3}, 1);
    Rigid place = Rigid::Identity();
    place.translation() = Vec3(0.4, 0.2, -0.25);
    const auto pebble = std::make_shared<Obstacle>(make_sphere(0.3), place);
    const ContactMaterial material{.stiffness_pa_per_m = 1e3, .thickness_m = 0.01};
    const ObstacleContact nodes(surface_samples(body.positions, body.triangles, 1), pebble,
                                material);
    EXPECT_EQ(nodes.touching(0, body.positions), 0);
    const int parts = parts_per_side(body.positions, body.triangles, 0.2);
    const ObstacleContact fine(surface_samples(body.positions, body.triangles, parts), pebble,
                               material);
    EXPECT_GT(fine.touching(0, body.positions), 0);
    const Vec3 force = fine.total_force(0, body.positions, Points::Zero(8, 3));
    EXPECT_GT(force.z(), 0);
}

}  // namespace
}  // namespace risorius::contact
