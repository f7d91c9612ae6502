// SPDX-License-Identifier: MIT
// Tendons perpendicular to a plane: their force, its derivatives, and what keeps the end in front of its plate.

#include <gtest/gtest.h>

#include <cmath>

#include "force_term_checks.h"
#include "risorius/core/error.h"
#include "risorius/muscle/musculotendon.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::muscle {
namespace {

using testing_of::random_points;

const tissue::GridShape kGrid{3, 3, 2};
const MuscleParameters kPrototype{.f0_n = 94.2, .optimal_length_m = 0.04, .tendon_slack_m = 0.02};
constexpr int kChains = 6;

Points belly() { return tissue::block_rest(kGrid, {0.04, 0.02, 0.01}); }

Anchors planes() {
    return {plane_anchor(End::kOrigin, kGrid, belly(), 0.01),
            plane_anchor(End::kInsertion, kGrid, belly(), 0.01)};
}

Musculotendon muscle(Anchors anchors, double activation) {
    return Musculotendon(kPrototype, zajac_curves(), kGrid, belly(), std::move(anchors),
                         [activation](double) { return activation; });
}

/// The insertion's plate moves sideways and rotates about every axis.
Anchors moving_planes() {
    Anchors anchors = planes();
    anchors.insertion.motion = [](double t_s) {
        return Rigid(Eigen::Translation3d(0.004 * t_s, 0.002, -0.001) *
                     Eigen::AngleAxisd(0.2 * t_s, Vec3(0.3, 0.5, std::sqrt(1 - 0.09 - 0.25))));
    };
    return anchors;
}

/// Shorter, wider and disordered: fibres and tendons pull.
Points swollen() {
    Points x = belly();
    x.col(0) = 0.85 * x.col(0).array() + 0.003;
    x.rightCols<2>() *= 1.1;
    return x + random_points(x.rows(), 2e-4, 1);
}

/// Sum of the moments of forces about the origin.
Vec3 torque(const Points& at, const Points& force) {
    Vec3 sum = Vec3::Zero();
    for (long i = 0; i < at.rows(); ++i) sum += Vec3(at.row(i)).cross(Vec3(force.row(i)));
    return sum;
}

TEST(PlaneAnchor, PotentialHasItsGradientAndHessianAndTheForceIsTheSlopeOfTheEnergy) {
    const Musculotendon m = muscle(moving_planes(), 0.7);
    const Points x = swollen();
    const solve::ImplicitStep step{0.8, std::numeric_limits<double>::infinity(), x};
    testing_of::expect_gradient_of_potential(m, step, x, 1e-8, 1e-5);
    testing_of::expect_hessian_of_potential(m, step, x, 1e-8, 1e-5);
    testing_of::expect_projection(m, step, x);
    testing_of::expect_force_is_minus_slope_of_energy(m, 0.8, x, 1e-8, 1e-5);
}

TEST(PlaneAnchor, ForcesAndTorquesOnMuscleAndPlatesSumToZero) {
    const Musculotendon m = muscle(moving_planes(), 0.8);
    const Points x = swollen();
    Points force = Points::Zero(x.rows(), 3);
    m.add_force(0.8, x, random_points(x.rows(), 0.2, 2), force);
    const Points origin = m.anchor_forces(End::kOrigin, 0.8, x),
                 insertion = m.anchor_forces(End::kInsertion, 0.8, x);
    EXPECT_GT(force.cwiseAbs().maxCoeff(), 1);
    EXPECT_EQ(m.anchor_pull(End::kOrigin, 0.8, x), Vec3(origin.colwise().sum()));
    EXPECT_LT((force.colwise().sum() + origin.colwise().sum() + insertion.colwise().sum()).norm(),
              1e-11);
    EXPECT_LT((torque(x, force) + torque(x.topRows(kChains), origin) +
               torque(x.bottomRows(kChains), insertion))
                  .norm(),
              1e-12);
}

TEST(PlaneAnchor, TendonsFeelTheirDistanceFromThePlaneAlone) {
    const Musculotendon m = muscle(planes(), 0);
    Points x = belly();
    x.bottomRows(kChains).col(0).array() -= 0.01 * 0.033;
    EXPECT_NEAR(m.anchor_pull(End::kInsertion, 0, x).x(), -94.2, 1e-9);
    const Points before = m.anchor_forces(End::kInsertion, 0, x);
    const Vec3 middle = belly().bottomRows(kChains).colwise().mean();
    for (int i = x.rows() - kChains; i < x.rows(); ++i)
        for (const int axis : {1, 2}) x(i, axis) += 0.4 * (x(i, axis) - middle[axis]);
    const Points after = m.anchor_forces(End::kInsertion, 0, x);
    EXPECT_LT((after - before).cwiseAbs().maxCoeff(), 1e-9) << "swelling is free";
    // Their feet move with them.
    const Points feet = m.tendon_feet(End::kInsertion, 0, x);
    for (int c = 0; c < kChains; ++c) {
        EXPECT_NEAR(feet(c, 0), 0.05, 1e-15);
        EXPECT_NEAR(feet(c, 1), x(x.rows() - kChains + c, 1), 1e-15);
    }
    // Beyond the plane the tendons do not pull.
    x.bottomRows(kChains).col(0).array() += 0.03;
    EXPECT_LT(m.anchor_forces(End::kInsertion, 0, x).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PlaneAnchor, DriftAndTurnAlongThePlaneAreDrawnBackWithF0OverTheOptimalLength) {
    const Musculotendon m = muscle(planes(), 0);
    const double stiffness = 94.2 / 0.04;
    Points x = belly();
    x.topRows(kChains).col(1).array() += 1e-3;
    const Vec3 pull = m.anchor_pull(End::kOrigin, 0, x);
    EXPECT_NEAR(pull.x(), 0, 1e-9);
    EXPECT_NEAR(pull.y(), 1e-3 * stiffness, 1e-9);
    EXPECT_NEAR(pull.z(), 0, 1e-9);

    x = belly();
    const Vec3 middle = x.topRows(kChains).colwise().mean();
    const Eigen::AngleAxisd turn(0.1, Vec3::UnitX());
    double square_radius = 0;
    for (int c = 0; c < kChains; ++c) {
        const Vec3 r = x.row(c).transpose() - middle;
        square_radius += r.squaredNorm() / kChains;
        x.row(c) = (middle + turn * r).transpose();
    }
    const Points forces = m.anchor_forces(End::kOrigin, 0, x);
    EXPECT_LT(forces.colwise().sum().norm(), 1e-9);
    EXPECT_NEAR(torque(x.topRows(kChains), forces).x(),
                stiffness * square_radius * std::sin(0.1) * std::cos(0.1), 1e-12);
}

TEST(PlaneAnchor, RigidTendonsAreRefused) {
    MuscleParameters parameters = kPrototype;
    parameters.tendon = TendonModel::kRigid;
    try {
        Musculotendon(parameters, zajac_curves(), kGrid, belly(), planes(),
                      [](double) { return 0.0; });
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "muscle/tendon: expected \"elastic\" between planes, found \"rigid\"");
    }
}

}  // namespace
}  // namespace risorius::muscle
