// SPDX-License-Identifier: MIT
#include "risorius/contact/surface_contact.h"

#include <gtest/gtest.h>

#include <limits>

#include "contact/shapes.h"
#include "force_term_checks.h"
#include "geom/test_surfaces.h"
#include "risorius/contact/detail/carried_frame.h"

namespace risorius::contact {
namespace {

using namespace testing_of;

const ContactMaterial kRough{.stiffness_pa_per_m = 2e4,
                             .thickness_m = 0.05,
                             .friction = 0.6,
                             .slip_speed_m_per_s = 0.05,
                             .damping_s = 0.02};

/// Two boxes with a small overlap, both deformed. The nodes of the upper one come last.
struct TwoBoxes {
    testing::Surface lower = testing::box({-0.5, -0.5, -1}, {1, 1, 1}, 2);
    testing::Surface upper = testing::box({-0.2, -0.3, -0.01}, {0.6, 0.7, 0.5}, 1);
    int first = static_cast<int>(lower.positions.rows());
    Points rest, x, v;
    Triangles upper_triangles = upper.triangles.array() + first;

    TwoBoxes() {
        rest.resize(first + upper.positions.rows(), 3);
        rest << lower.positions, upper.positions;
        x = rest + random_points(rest.rows(), 0.02, 4);
        v = random_points(rest.rows(), 0.3, 6);
    }
    SurfaceContact contact(const ContactMaterial& material) const {
        return {rest, lower.triangles, upper_triangles, material};
    }
};

/// Checks net force and torque about the origin, as fractions of the maximum force.
void expect_balanced(const Points& force, const Points& x) {
    Vec3 net = Vec3::Zero(), torque = Vec3::Zero();
    for (long i = 0; i < x.rows(); ++i) {
        const Vec3 f = force.row(i).transpose(), p = x.row(i).transpose();
        net += f;
        torque += p.cross(f);
    }
    const double scale = force.cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 0);
    EXPECT_LT(net.norm(), 1e-13 * scale);
    EXPECT_LT(torque.norm(), 1e-13 * scale);
}

TEST(CarriedFrame, DerivativesBelongToThePlace) {
    const Points at = random_points(4, 1.0, 17);
    const Vec3 weights(0.2, 0.5, 0.3), y(0.3, -0.8, 0.5);
    const auto frame = [&](const Points& q) {
        return CarriedFrame(q.row(0).transpose(),
                            {q.row(1).transpose(), q.row(2).transpose(), q.row(3).transpose()},
                            weights);
    };
    const CarriedFrame exact = frame(at);
    const double h = 1e-6;
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 3; ++k) {
            Points above = at, below = at;
            above(j, k) += h, below(j, k) -= h;
            const Vec3 slope = (frame(above).place() - frame(below).place()) / (2 * h);
            EXPECT_LT((exact.slope(j).col(k) - slope).norm(), 1e-8);
            for (int i = 0; i < 4; ++i) {
                const Vec3 second = (frame(above).slope(i).transpose() * y -
                                     frame(below).slope(i).transpose() * y) /
                                    (2 * h);
                EXPECT_LT((exact.second_slope(y, i, j).col(k) - second).norm(), 1e-7)
                    << "points " << i << ", " << j;
            }
        }
}

TEST(SurfaceContact, ForceIsMinusTheSlopeOfTheEnergy) {
    const TwoBoxes boxes;
    SurfaceContact contact = boxes.contact({.stiffness_pa_per_m = 2e4, .thickness_m = 0.05});
    contact.begin_step(0, 0.01, boxes.x, boxes.v);
    expect_force_is_minus_slope_of_energy(contact, 0, boxes.x, 1e-6, 1e-7);
}

TEST(SurfaceContact, GradientAndHessianBelongToThePotentialOfAStepWithFrictionAndDamping) {
    const TwoBoxes boxes;
    SurfaceContact contact = boxes.contact(kRough);
    contact.begin_step(0, 0.1, boxes.x, boxes.v);
    const Points x = boxes.x + random_points(boxes.x.rows(), 0.008, 8);
    const solve::ImplicitStep step{0.1, 0.1, boxes.x};
    expect_gradient_of_potential(contact, step, x, 1e-6, 1e-7);
    expect_hessian_of_potential(contact, step, x, 1e-6, 2e-5);
    expect_projection(contact, step, x);
}

TEST(SurfaceContact, NetForceAndTorqueVanishWithFrictionAndDamping) {
    const TwoBoxes boxes;
    SurfaceContact contact = boxes.contact(kRough);
    contact.begin_step(0, 0.1, boxes.x, boxes.v);
    const Points x = boxes.x + random_points(boxes.x.rows(), 0.01, 8);
    Points force = Points::Zero(x.rows(), 3);
    contact.add_force(0, x, boxes.v, force);
    expect_balanced(force, x);
    expect_balanced(potential_gradient(contact, {0.1, 0.1, boxes.x}, x), x);
}

TEST(SurfaceContact, BodiesThatTurnTogetherDoNotRub) {
    const TwoBoxes boxes;
    SurfaceContact contact = boxes.contact(kRough);
    contact.begin_step(0, 0.1, boxes.x, boxes.v);
    const Mat3 turn = Eigen::AngleAxisd(0.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Points turned = boxes.x * turn.transpose();
    Points unused = Points::Zero(turned.rows(), 3);
    EXPECT_NEAR(contact.add_potential({0.1, 0.1, boxes.x}, turned, unused),
                contact.energy(0, boxes.x), 1e-12);
}

TEST(SurfaceContact, BothBodiesFeelTheSameForce) {
    const TwoBoxes boxes;
    SurfaceContact contact = boxes.contact({.stiffness_pa_per_m = 2e4, .thickness_m = 0.05});
    contact.begin_step(0, 0.01, boxes.rest, boxes.v);
    Points force = Points::Zero(boxes.rest.rows(), 3);
    contact.add_force(0, boxes.rest, boxes.v, force);
    const Vec3 on_lower = force.topRows(boxes.first).colwise().sum().transpose();
    const Vec3 on_upper = force.bottomRows(force.rows() - boxes.first).colwise().sum().transpose();
    EXPECT_LT(on_lower.z(), 0);
    EXPECT_LT((on_lower + on_upper).norm(), 1e-12 * on_lower.norm());
    EXPECT_LT((contact.force_on_first(boxes.rest) - on_lower).norm(), 1e-12 * on_lower.norm());
}

TEST(SurfaceContact, ASunkenCornerIsPushedOutTheWayItCame) {
    // Two equal cubes, stacked exactly and 1 mm inside each other. At the edges, the nearest way out is sideways.
    const auto lower = testing::box({0, 0, 0}, {1, 1, 1}, 2);
    const auto upper = testing::box({0, 0, 0.999}, {1, 1, 1}, 2);
    const int first = static_cast<int>(lower.positions.rows());
    Points x(2 * first, 3);
    x << lower.positions, upper.positions;
    SurfaceContact contact(x, lower.triangles, upper.triangles.array() + first,
                           {.stiffness_pa_per_m = 1e4, .thickness_m = 0.01});
    contact.begin_step(0, 0.01, x, Points::Zero(2 * first, 3));
    Points force = Points::Zero(2 * first, 3);
    contact.add_force(0, x, Points::Zero(2 * first, 3), force);
    for (int i = 0; i < 2 * first; ++i) {
        EXPECT_NEAR(force(i, 0), 0, 0.01) << i;
        EXPECT_NEAR(force(i, 1), 0, 0.01) << i;
    }
    // 60 N on the square metre. The samples on the rim also represent parts of the sides, which adds a quarter.
    EXPECT_NEAR(contact.force_on_first(x).z(), -1.25 * 1e4 * (0.005 + 0.001), 0.5);
}

TEST(SurfaceContact, FarBodiesHaveNoPairs) {
    TwoBoxes boxes;
    for (long i = boxes.first; i < boxes.x.rows(); ++i) boxes.x(i, 2) += 3;
    SurfaceContact contact = boxes.contact(kRough);
    contact.begin_step(0, 0.01, boxes.x, boxes.v);
    EXPECT_EQ(contact.pair_count(), 0);
    EXPECT_EQ(contact.energy(0, boxes.x), 0);
    EXPECT_EQ(contact.min_gap_m(boxes.x), std::numeric_limits<double>::infinity());
}

TEST(SurfaceContact, SamplesOfAnOpenSheetPressOnAClosedBody) {
    const auto body = testing::box({-1, -1, -1}, {3, 3, 1}, 2);
    const auto sheet = geom::testing::square_grid(3);
    const int first = static_cast<int>(body.positions.rows());
    Points x(first + sheet.positions.rows(), 3);
    x << body.positions, sheet.positions;
    const Triangles sheet_triangles = sheet.triangles.array() + first;
    const auto samples = surface_samples(x, sheet_triangles, 1);
    SurfaceContact contact(x, samples, body.triangles,
                           {.stiffness_pa_per_m = 1e4, .thickness_m = 0.01});
    contact.begin_step(0, 0.01, x, Points::Zero(x.rows(), 3));
    EXPECT_NEAR(contact.force_on_first(x).z(), 1e4 * 0.005, 1e-9);  // area 1 m^2, gap 0
}

}  // namespace
}  // namespace risorius::contact
