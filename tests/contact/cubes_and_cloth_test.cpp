// SPDX-License-Identifier: MIT
// Soft cubes on each other, and cloth over rigid and soft bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "contact/shapes.h"
#include "contact/soft_scene.h"
#include "geom/test_surfaces.h"
#include "risorius/contact/distance_field.h"
#include "risorius/contact/obstacle_contact.h"
#include "risorius/contact/surface_contact.h"
#include "risorius/tissue/grid_surface.h"

namespace risorius::contact {
namespace {

using testing::SoftScene;

constexpr double kGravity = 9.81;
constexpr double kThickness_m = 1e-3;
ContactMaterial touch(double friction, double slip_speed) {
    return {.stiffness_pa_per_m = stiffness_for(3 * kGravity / 0.01, kThickness_m),
            .thickness_m = kThickness_m,
            .friction = friction,
            .slip_speed_m_per_s = slip_speed,
            .damping_s = 2e-3};
}
const ContactMaterial kTouch = touch(0.5, 1e-2);

std::shared_ptr<SurfaceContact> between(SoftScene& scene, const ContactMaterial& material) {
    return scene.add(std::make_shared<SurfaceContact>(scene.state.x, scene.surface(0),
                                                      scene.surface(1), material));
}

/// A cube on a floor, and another one dropped on it, possibly displaced sideways.
struct Stack {
    SoftScene scene;
    std::shared_ptr<ObstacleContact> floor;
    std::shared_ptr<SurfaceContact> contact;

    Stack(const Vec3& aside, const ContactMaterial& material) {
        constexpr double kViscosity_pa_s = 300;  // rocking ends within the run
        scene.add_block({0, 0, 0.5 * kThickness_m}, kViscosity_pa_s);
        scene.add_block(Vec3(0, 0, 0.1 + 3e-3) + aside, kViscosity_pa_s);
        scene.add_gravity({0, 0, -kGravity});
        contact = between(scene, material);
        floor = scene.add(
            std::make_shared<ObstacleContact>(surface_samples(scene.state.x, scene.surface(0), 2),
                                              std::make_shared<Obstacle>(make_plane()), material));
    }
};

TEST(StackedCubes, RestOnEachOtherWithTheirWeights) {
    Stack stack({0.012, -0.007, 0}, touch(0.5, 1e-3));
    const auto system = stack.scene.system();
    const auto report = testing::implicit_steps(1.0 / 60)->advance(system, stack.scene.state, 1.5);
    EXPECT_TRUE(report.converged);
    const Points& x = stack.scene.state.x;
    system.begin_step(1.5, 1.0 / 60, x, stack.scene.state.v);
    EXPECT_NEAR(stack.contact->force_on_first(x).z(), -kGravity, 0.01 * kGravity);
    EXPECT_NEAR(stack.floor->total_force(1.5, x, stack.scene.state.v).z(), 2 * kGravity,
                0.01 * 2 * kGravity);
    // The lower cube carries its neighbour on a part of its face, with up to three times the mean pressure.
    EXPECT_GT(stack.contact->min_gap_m(x), 0) << "no part of one lies in the other";
    EXPECT_LT(stack.scene.state.v.cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_GT(stack.scene.middle(1).z(), 0.145);
    const int top = stack.scene.grid.index(1, 1, 2), bottom = 27 + stack.scene.grid.index(1, 1, 0);
    EXPECT_NEAR(x(bottom, 0) - x(top, 0), 0.012, 2e-3) << "friction keeps it in place";
}

TEST(StackedCubes, EndInTheSameStateInExplicitAndImplicitSteps) {
    Points end[2];
    for (const bool is_implicit : {false, true}) {
        Stack stack({0, 0, 0}, kTouch);
        const auto system = stack.scene.system();
        const auto steps =
            is_implicit ? testing::implicit_steps(1.0 / 120) : testing::explicit_steps(2e-4);
        steps->advance(system, stack.scene.state, 0.6);
        end[is_implicit] = stack.scene.state.x;
    }
    // The rims still creep along each other, slower than the slip speed.
    EXPECT_LT((end[0] - end[1]).cwiseAbs().maxCoeff(), 1e-4);
}

/// Sum of m v, and of x cross m v about the origin.
std::pair<Vec3, Vec3> momentum(const SoftScene& scene) {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (int i = 0; i < scene.mass.size(); ++i) {
        const Vec3 x = scene.state.x.row(i).transpose(), v = scene.state.v.row(i).transpose();
        linear += scene.mass[i] * v;
        angular += scene.mass[i] * x.cross(v);
    }
    return {linear, angular};
}

/// Two cubes in free space, thrown at each other off-centre.
SoftScene collision() {
    SoftScene scene;
    scene.add_block({0, 0, 0});
    scene.add_block({0.04, 0.02, 0.104});
    for (int i = 0; i < scene.grid.size(); ++i) {
        scene.state.v.row(i) << 0.1, 0, 0.3;
        scene.state.v.row(scene.grid.size() + i) << -0.05, 0.05, -0.3;
    }
    return scene;
}

TEST(CollidingCubes, KeepMomentumAndAngularMomentumInExplicitSteps) {
    SoftScene scene = collision();
    const auto contact = between(scene, kTouch);
    const auto [linear, angular] = momentum(scene);
    const auto system = scene.system();
    const auto steps = testing::explicit_steps(2e-4);
    steps->advance(system, scene.state, 0.02);
    EXPECT_LT(contact->force_on_first(scene.state.x).z(), -1) << "in the middle of the blow";
    steps->advance(system, scene.state, 0.15);
    EXPECT_GT(scene.velocity(1).z(), 0) << "they must have bounced off";
    EXPECT_LT((momentum(scene).first - linear).norm(), 1e-13);
    // The terms cause no rotation. The error of Runge-Kutta in the angular momentum is of the order of its accuracy.
    EXPECT_LT((momentum(scene).second - angular).norm(), 1e-8 * angular.norm());
}

TEST(CollidingCubes, KeepMomentumInImplicitStepsAndDoNotPassThroughEachOther) {
    SoftScene scene = collision();
    const auto contact = between(scene, kTouch);
    const Vec3 linear = momentum(scene).first;
    const auto system = scene.system();
    const auto steps = testing::implicit_steps(1.0 / 240);
    double min = 1;
    for (int i = 1; i <= 36; ++i) {
        steps->advance(system, scene.state, i / 240.0);
        min = std::min(min, contact->min_gap_m(scene.state.x));
    }
    EXPECT_GT(scene.velocity(1).z(), scene.velocity(0).z()) << "they must have bounced off";
    // Newton's method stops at 1e-6 of the cube's side, so the error of its force is of that order.
    EXPECT_LT((momentum(scene).first - linear).norm(), 1e-6);
    // Depth of an impact at 0.6 m/s between cubes of 1 kg.
    EXPECT_GT(min, -3e-3);
}

TEST(CollidingCubes, EndInTheSameBitsInTwoRuns) {
    Points end[2];
    for (Points& x : end) {
        SoftScene scene = collision();
        between(scene, kTouch);
        testing::implicit_steps(1.0 / 60)->advance(scene.system(), scene.state, 0.1);
        x = scene.state.x;
    }
    EXPECT_EQ(std::memcmp(end[0].data(), end[1].data(), sizeof(double) * end[0].size()), 0);
}

/// A cloth of 0.4 m and 80 g, 2 cm above the highest point of the body it falls on.
struct Cloth {
    static constexpr int kNodes = 13;  // along a side
    tissue::GridSurface sheet;
    solve::MotionState state;
    Eigen::VectorXd mass;

    explicit Cloth(double height_m) {
        sheet.grid = {kNodes, kNodes};
        Rigid place = Rigid::Identity();
        place.translation() = Vec3(-0.2, -0.2, height_m);
        sheet.rest = tissue::sheet_rest(sheet.grid, {0.4, 0.4}, place);
        // Membrane 40 N/m, bending 2e-5 N m.
        tissue::SheetConstants constants;
        constants.membrane_n_per_m.setConstant(40);
        constants.bending_n_m.setConstant(2e-5);
        auto material = tissue::surface_material(constants, {0.4, 0.4});
        material.mass_kg = 0.08;
        material.damping_ns_per_m3 = 0.01 * material.elastic_n_per_m3;
        sheet.material = {material};
        state.x = sheet.rest;
        state.v = Points::Zero(sheet.rest.rows(), 3);
        mass = tissue::node_mass(sheet);
    }
    Triangles triangles() const { return tissue::surface_triangles(sheet.grid); }
};

TEST(Cloth, DrapesOverASphereAndOverAMeshWithoutPassingThrough) {
    const auto rock = testing::box({-0.1, -0.1, -0.2}, {0.2, 0.2, 0.2}, 1);
    Rigid turned = Rigid::Identity();
    turned.linear() = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
    Rigid below = Rigid::Identity();
    below.translation() = Vec3(0, 0, -0.12);
    const auto ball = std::make_shared<Obstacle>(make_sphere(0.12), below);
    const auto block = std::make_shared<Obstacle>(
        make_mesh(rock.positions, rock.triangles, {.cells = 24}), turned);
    constexpr double kDuration_s = 0.6;
    for (const auto& obstacle : {ball, block}) {
        Cloth cloth(0.02);
        // A hundred times the cloth's own weight per area.
        const ContactMaterial material{
            .stiffness_pa_per_m = stiffness_for(100 * 0.08 * kGravity / 0.16, 2e-3),
            .thickness_m = 2e-3,
            .friction = 0.3,
            .slip_speed_m_per_s = 1e-2};
        const auto contact = std::make_shared<ObstacleContact>(
            surface_samples(cloth.state.x, cloth.triangles(), 3), obstacle, material);
        solve::MotionSystem system(cloth.mass, std::vector<char>(cloth.mass.size(), 0));
        system.add(std::make_shared<tissue::GridSurfaceTerm>(cloth.sheet));
        system.add(std::make_shared<tissue::Gravity>(cloth.mass));
        system.add(contact);
        const auto report =
            testing::implicit_steps(1.0 / 60)->advance(system, cloth.state, kDuration_s);
        EXPECT_FALSE(report.diverged);
        // Measured with four times as many samples as the contact has.
        const ObstacleContact fine(surface_samples(cloth.sheet.rest, cloth.triangles(), 6),
                                   obstacle, material);
        EXPECT_GT(contact->min_gap_m(kDuration_s, cloth.state.x), -1e-3);
        EXPECT_GT(fine.min_gap_m(kDuration_s, cloth.state.x), -4e-3);
        EXPECT_GT(contact->touching(kDuration_s, cloth.state.x), 20);
        EXPECT_GT(cloth.state.x.row(Cloth::kNodes * Cloth::kNodes / 2).z(), 0.0)
            << "its middle lies on top";
        EXPECT_LT(cloth.state.x.row(0).z(), -0.05) << "its corners hang";
    }
}

}  // namespace
}  // namespace risorius::contact
