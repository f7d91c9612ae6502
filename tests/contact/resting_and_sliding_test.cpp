// SPDX-License-Identifier: MIT
// A soft cube on obstacles, with explicit and implicit steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "contact/soft_scene.h"
#include "geom/test_surfaces.h"
#include "risorius/contact/distance_field.h"
#include "risorius/contact/obstacle_contact.h"

namespace risorius::contact {
namespace {

using testing::SoftScene;

constexpr double kGravity = 9.81;
constexpr double kThickness_m = 1e-3;
// Carries three times the pressure of the cube's weight on its face before the surfaces meet.
const double kStiffness = stiffness_for(3 * kGravity / 0.01, kThickness_m);
constexpr double kSlipSpeed = 1e-3;
// Sticking friction is a damper of 2 mu N / v_s: 9.8e3 N s/m here. Explicit steps of 0.2 ms are stable only with a tenth of it.
constexpr double kSlipSpeedExplicit = 1e-2;

ContactMaterial material(double friction, double slip_speed = kSlipSpeed) {
    return {.stiffness_pa_per_m = kStiffness,
            .thickness_m = kThickness_m,
            .friction = friction,
            .slip_speed_m_per_s = slip_speed,
            .damping_s = 2e-3};
}

struct OnSlope {
    SoftScene scene;
    std::shared_ptr<ObstacleContact> contact;

    /// The slope is level and gravity is tilted instead.
    OnSlope(double degrees, double friction, double slip_speed = kSlipSpeed) {
        const double a = degrees * M_PI / 180;
        scene.add_block({0, 0, 0.5 * kThickness_m});
        scene.add_gravity(kGravity * Vec3(std::sin(a), 0, -std::cos(a)));
        contact = scene.add(std::make_shared<ObstacleContact>(
            surface_samples(scene.state.x, scene.surface(), 2),
            std::make_shared<Obstacle>(make_plane()), material(friction, slip_speed)));
    }
};

class InBothSteppings : public ::testing::TestWithParam<bool> {
  public:
    static std::unique_ptr<solve::Integrator> integrator() {
        return GetParam() ? testing::implicit_steps(1.0 / 120) : testing::explicit_steps(2e-4);
    }
    static double slip_speed() { return GetParam() ? kSlipSpeed : kSlipSpeedExplicit; }
};

// The friction angle of mu = 0.5 is 26.6 degrees.
TEST_P(InBothSteppings, ACubeStaysOnASlopeBelowTheFrictionAngleButForACreepUnderTheSlipSpeed) {
    OnSlope slope(20, 0.5, slip_speed());
    const auto system = slope.scene.system();
    const auto steps = integrator();
    steps->advance(system, slope.scene.state, 0.5);  // comes to equilibrium
    const double from = slope.scene.middle().x();
    steps->advance(system, slope.scene.state, 1.0);
    const double creep = (slope.scene.middle().x() - from) / 0.5;
    EXPECT_GT(creep, 0);
    EXPECT_LT(creep, slip_speed());
}

TEST_P(InBothSteppings, ACubeSlidesDownASteeperSlopeAsCoulombSays) {
    OnSlope slope(35, 0.5, slip_speed());
    const auto system = slope.scene.system();
    const auto steps = integrator();
    steps->advance(system, slope.scene.state, 0.4);
    const double before = slope.scene.velocity().x();
    steps->advance(system, slope.scene.state, 0.8);
    const double acceleration = (slope.scene.velocity().x() - before) / 0.4;
    const double a = 35 * M_PI / 180;
    // 3 %: the normal force still oscillates a little while the cube comes to equilibrium.
    EXPECT_NEAR(acceleration, kGravity * (std::sin(a) - 0.5 * std::cos(a)), 0.03 * 1.609);
}

INSTANTIATE_TEST_SUITE_P(Contact, InBothSteppings, ::testing::Bool(), [](const auto& p) {
    return p.param ? std::string("Implicit") : std::string("Explicit");
});

struct Rest {
    const char* name;
    std::shared_ptr<const Obstacle> obstacle;
    double deepest_m;  // upper bound of the penetration
};

std::vector<Rest> supports() {
    Rigid below = Rigid::Identity();
    below.translation() = Vec3(0.05, 0.05, -0.2);
    const auto hill = geom::testing::sphere(24, 48, 0.2);
    // On a curved support the weight acts on a smaller area with a higher pressure, so the penetration is deeper.
    return {{"plane", std::make_shared<Obstacle>(make_plane()), 0},
            {"sphere", std::make_shared<Obstacle>(make_sphere(0.2), below), 1e-3},
            {"capsule",
             std::make_shared<Obstacle>(make_capsule({-0.1, 0, 0}, {0.1, 0, 0}, 0.2), below), 1e-3},
            {"mesh",
             std::make_shared<Obstacle>(make_mesh(hill.positions, hill.triangles, {.cells = 32}),
                                        below),
             1e-3}};
}

TEST(RestingCube, IsCarriedByItsWeightOnEveryObstacleAndSinksInLittle) {
    for (const Rest& rest : supports()) {
        SoftScene scene;
        scene.add_block({0, 0, 5e-3});  // falls 4 to 5 mm
        scene.add_gravity({0, 0, -kGravity});
        const auto contact = scene.add(std::make_shared<ObstacleContact>(
            surface_samples(scene.state.x, scene.surface(), 2), rest.obstacle, material(0.5)));
        const auto system = scene.system();
        const auto report = testing::implicit_steps(1.0 / 60)->advance(system, scene.state, 1.5);
        EXPECT_TRUE(report.converged) << rest.name;
        const Vec3 force = contact->total_force(1.5, scene.state.x, scene.state.v);
        EXPECT_NEAR(force.z(), kGravity, 0.01 * kGravity) << rest.name;
        EXPECT_LT(force.head<2>().norm(), 0.01 * kGravity) << rest.name;
        EXPECT_GT(contact->min_gap_m(1.5, scene.state.x), -rest.deepest_m) << rest.name;
        EXPECT_LT(contact->min_gap_m(1.5, scene.state.x), kThickness_m) << rest.name;
        EXPECT_LT(scene.state.v.cwiseAbs().maxCoeff(), 1e-3) << rest.name;
    }
}

TEST(RestingCube, EndsInTheSameStateInExplicitAndImplicitSteps) {
    Points end[2];
    for (const bool is_implicit : {false, true}) {
        SoftScene scene;
        scene.add_block({0, 0, 3e-3});
        scene.add_gravity({0, 0, -kGravity});
        scene.add(std::make_shared<ObstacleContact>(
            surface_samples(scene.state.x, scene.surface(), 2),
            std::make_shared<Obstacle>(make_plane()), material(0)));
        const auto system = scene.system();
        const auto steps =
            is_implicit ? testing::implicit_steps(1.0 / 60) : testing::explicit_steps(4e-4);
        steps->advance(system, scene.state, 1.5);
        end[is_implicit] = scene.state.x;
    }
    // One micrometre: the remaining oscillation of the explicit run is smaller.
    EXPECT_LT((end[0] - end[1]).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(RestingCube, IsDraggedAlongByAMovingFloor) {
    SoftScene scene;
    scene.add_block({0, 0, 0.5 * kThickness_m});
    scene.add_gravity({0, 0, -kGravity});
    Rigid there = Rigid::Identity();
    there.translation() = Vec3(0.1, 0, 0);
    const auto floor = std::make_shared<Obstacle>(
        make_plane(), gliding(Rigid::Identity(), there, 0.2, 1.2));  // at most 0.6 m/s^2
    scene.add(std::make_shared<ObstacleContact>(surface_samples(scene.state.x, scene.surface(), 2),
                                                floor, material(0.5)));
    const auto system = scene.system();
    const double from = scene.middle().x();
    testing::implicit_steps(1.0 / 60)->advance(system, scene.state, 1.6);
    // It lags behind by less than the slip speed times the duration of the motion.
    EXPECT_NEAR(scene.middle().x() - from, 0.1, kSlipSpeed * 1.0);
}

TEST(RestingCube, IsTheSameToTheLastBitInTwoRuns) {
    Points end[2];
    for (Points& x : end) {
        OnSlope slope(30, 0.5);
        testing::implicit_steps(1.0 / 60)->advance(slope.scene.system(), slope.scene.state, 0.2);
        x = slope.scene.state.x;
    }
    EXPECT_EQ(std::memcmp(end[0].data(), end[1].data(), sizeof(double) * end[0].size()), 0);
}

}  // namespace
}  // namespace risorius::contact
