// SPDX-License-Identifier: MIT
// The musculotendon's forces: laws, derivatives compared with differences, pennation, and what is rejected.

#include "risorius/muscle/musculotendon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <stdexcept>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::muscle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const tissue::GridShape kGrid{4, 3, 3};
const MuscleParameters kPrototype{.f0_n = 94.2, .optimal_length_m = 0.04, .tendon_slack_m = 0.02};

Points belly(double length_m = 0.04) { return tissue::cylinder_rest(kGrid, 0.01, length_m); }

ActivationAt always(double a) {
    return [a](double) { return a; };
}

Musculotendon muscle(const MuscleParameters& parameters, double activation,
                     double length_m = 0.04) {
    const Points rest = belly(length_m);
    return Musculotendon(parameters, zajac_curves(), kGrid, rest,
                         planar_anchors(kGrid, rest, parameters.tendon_slack_m),
                         always(activation));
}

Points shaken(const Points& x, double by, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shake(-by, by);
    Points y = x;
    for (Eigen::Index i = 0; i < y.size(); ++i) y.data()[i] += shake(random);
    return y;
}

/// Stretched by 12 %, so that fibres and tendons all pull, and disordered.
Points stretched(double by = 1.12) {
    Points x = belly();
    x.col(0) *= by;
    return shaken(x, 2e-4, 1);
}

MuscleParameters pennate(double deg) {
    MuscleParameters parameters = kPrototype;
    parameters.pennation_deg = deg;
    return parameters;
}

Points zeros() { return Points::Zero(kGrid.size(), 3); }

TEST(Musculotendon, IsometricForceIsTheSlopeOfTheEnergy) {
    for (const double deg : {0.0, 25.0}) {
        const Musculotendon m = muscle(pennate(deg), 0.7);
        const Points x = stretched();
        Points force = zeros();
        m.add_force(0, x, zeros(), force);
        const double h = 1e-8;
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            Points up = x, down = x;
            up.data()[i] += h;
            down.data()[i] -= h;
            const double slope = (m.energy(0, up) - m.energy(0, down)) / (2 * h);
            EXPECT_NEAR(force.data()[i], -slope, 2e-6 * force.cwiseAbs().maxCoeff()) << i;
        }
    }
}

TEST(Musculotendon, ForcesAndTorquesOnMuscleAndAnchorsSumToZero) {
    const Musculotendon m = muscle(pennate(15), 0.8);
    const Points x = stretched();
    const Points v = shaken(zeros(), 0.2, 2);
    Points force = zeros();
    m.add_force(0, x, v, force);
    Vec3 sum = force.colwise().sum(), torque = Vec3::Zero();
    for (int i = 0; i < x.rows(); ++i) torque += Vec3(x.row(i)).cross(Vec3(force.row(i)));
    for (const End end : {End::kOrigin, End::kInsertion}) {
        const Points points = m.anchor_points(end, 0), pulls = m.anchor_forces(end, 0, x);
        sum += m.anchor_pull(end, 0, x);
        for (int c = 0; c < points.rows(); ++c)
            torque += Vec3(points.row(c)).cross(Vec3(pulls.row(c)));
    }
    EXPECT_GT(force.cwiseAbs().maxCoeff(), 1);
    EXPECT_LT(sum.norm(), 1e-11);
    EXPECT_LT(torque.norm(), 1e-12);
}

TEST(Musculotendon, PotentialOfAStepHasItsGradientAndHessian) {
    const Points x = stretched(), start = shaken(x, 1e-4, 3);
    for (const double h : {1e-3, kInfinite}) {
        const Musculotendon m = muscle(pennate(20), 0.6);
        const solve::ImplicitStep step{0.1, h, start};
        Points gradient = zeros();
        m.add_potential(step, x, gradient);
        solve::HessianBuilder builder(kGrid.size(), {});
        m.add_hessian(step, x, solve::Curvature::kExact, builder);
        const Eigen::MatrixXd hessian =
            Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>();
        const double d = 1e-8;
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            Points up = x, down = x;
            up.data()[i] += d;
            down.data()[i] -= d;
            Points g_up = zeros(), g_down = zeros();
            const double slope =
                (m.add_potential(step, up, g_up) - m.add_potential(step, down, g_down)) / (2 * d);
            EXPECT_NEAR(gradient.data()[i], slope, 2e-6 * gradient.cwiseAbs().maxCoeff()) << i;
            const Points column = (g_up - g_down) / (2 * d);
            for (Eigen::Index j = 0; j < x.size(); ++j)
                ASSERT_NEAR(hessian(j, i), column.data()[j], 2e-5 * hessian.cwiseAbs().maxCoeff())
                    << j << ", " << i << " h = " << h;
        }
    }
}

TEST(Musculotendon, PositiveCurvatureHasNoNegativeEigenvalue) {
    for (const double h : {1e-3, kInfinite}) {
        const Points x = stretched(1.3), start = shaken(x, 3e-4, 4);
        const Musculotendon m = muscle(kPrototype, 1);
        solve::HessianBuilder builder(kGrid.size(), {});
        m.add_hessian({0, h, start}, x, solve::Curvature::kPositive, builder);
        const Eigen::MatrixXd hessian =
            Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>();
        const Eigen::VectorXd values = symmetric_eigenvalues(hessian);
        EXPECT_GT(values.maxCoeff(), 1e4);
        EXPECT_GT(values.minCoeff(), -1e-9 * values.maxCoeff());
    }
}

TEST(Musculotendon, AShortStepHasTheForceOfTheExplicitMethods) {
    const Musculotendon m = muscle(pennate(10), 0.9);
    const Points start = stretched(), v = shaken(zeros(), 0.1, 5);
    const double h = 1e-7;
    const Points x = start + h * v;
    Points gradient = zeros(), force = zeros();
    m.add_potential({0, h, start}, x, gradient);
    m.add_force(0, x, v, force);
    EXPECT_LT((gradient + force).cwiseAbs().maxCoeff(), 1e-4 * force.cwiseAbs().maxCoeff());
}

TEST(Musculotendon, AtOptimalLengthAMuscleCarriesF0TimesTheCosineOfItsPennation) {
    for (const double deg : {0.0, 30.0, 60.0}) {
        const double cosine = std::cos(deg * std::numbers::pi / 180);
        const Musculotendon m = muscle(pennate(deg), 1, 0.04 * cosine);
        const Points x = belly(0.04 * cosine);
        EXPECT_NEAR(m.stretch(x).minCoeff(), 1, 1e-12);
        Points force = zeros();
        m.add_force(0, x, zeros(), force);
        // Tendons are slack in the rest shape, so the end nodes get only the forces of fibres.
        EXPECT_NEAR(force.topRows(9).col(0).sum(), 94.2 * cosine, 1e-10);
        EXPECT_NEAR(force.bottomRows(9).col(0).sum(), -94.2 * cosine, 1e-10);
    }
}

TEST(Musculotendon, TendonsCarryF0AtTheirStrain) {
    const Points rest = belly();
    Anchors anchors = planar_anchors(kGrid, rest, 0.02);
    EXPECT_NEAR(anchors.origin.rest.col(0).maxCoeff(), -0.01, 1e-15);
    EXPECT_NEAR(anchors.insertion.rest.col(0).minCoeff(), 0.05, 1e-15);
    anchors.insertion.motion = [](double t_s) {
        return Rigid(Eigen::Translation3d(t_s * Vec3::UnitX()));
    };
    const Musculotendon m(kPrototype, zajac_curves(), kGrid, rest, anchors, always(0));
    EXPECT_NEAR(m.anchor_pull(End::kInsertion, 0.01 * 0.033, rest).x(), -94.2, 1e-9);
    EXPECT_LT(m.anchor_pull(End::kInsertion, 0, rest).norm(), 1e-20);
    EXPECT_LT(m.anchor_pull(End::kOrigin, 0.01 * 0.033, rest).norm(), 1e-20);
}

TEST(Musculotendon, ARelaxedMuscleAtRestIsFreeOfForce) {
    const Musculotendon m = muscle(kPrototype, 0);
    Points force = zeros();
    m.add_force(0, belly(), zeros(), force);
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Musculotendon, ForceLengthIsThatOfTheWholeChain) {
    // One segment is longer and one shorter. The chain has the same length, so both have the same tension.
    const Musculotendon m = muscle(kPrototype, 1);
    Points x = belly();
    x.middleRows(9, 9).col(0).array() += 0.002;
    x.middleRows(18, 9).col(0).array() += 0.001;
    EXPECT_NEAR(m.segment_spread(x), 3 * (0.002 + 0.001) / 0.04, 1e-12);
    Points force = zeros();
    m.add_force(0, x, zeros(), force);
    const double passive = 94.2 * zajac_curves().passive.value(1 + 3 * 0.002 / 0.04);
    EXPECT_NEAR(force.topRows(9).col(0).sum(), 94.2 + passive, 1e-10);
    EXPECT_NEAR(force.bottomRows(9).col(0).sum(), -94.2, 1e-10);
}

/// A ring of six slabs with only its fibres, disordered.
struct Ring {
    tissue::GridShape grid{6, 2, 2, true};
    Points rest = Points(grid.size(), 3), x;
    Ring() {
        for (int m = 0; m < 6; ++m)
            for (int n = 0; n < 2; ++n)
                for (int o = 0; o < 2; ++o) {
                    const double angle = std::numbers::pi / 3 * m, radius = 0.03 - 0.006 * n;
                    rest.row(grid.index(m, n, o)) << radius * std::cos(angle),
                        radius * std::sin(angle), 0.005 * o;
                }
        x = shaken(1.15 * rest, 1e-3, 6);
    }
    Musculotendon muscle(double activation) const {
        return Musculotendon({.f0_n = 9, .optimal_length_m = 0.16, .pennation_deg = 10},
                             zajac_curves(), grid, rest, {}, always(activation));
    }
};

TEST(Musculotendon, ARingPullsAllRoundAndItsPotentialHasItsGradientAndHessian) {
    const Ring ring;
    const Musculotendon m = ring.muscle(0.8);
    EXPECT_FALSE(m.anchored(End::kOrigin));
    EXPECT_EQ(m.anchor_pull(End::kOrigin, 0, ring.x), Vec3::Zero());
    const Points start = shaken(ring.x, 2e-4, 7);
    for (const double h : {1e-3, kInfinite}) {
        const solve::ImplicitStep step{0.1, h, start};
        testing_of::expect_gradient_of_potential(m, step, ring.x, 1e-8, 1e-5);
        testing_of::expect_hessian_of_potential(m, step, ring.x, 1e-8, 1e-5);
        testing_of::expect_projection(m, step, ring.x);
    }
    Points force = Points::Zero(ring.grid.size(), 3);
    m.add_force(0, ring.x, shaken(force, 0.1, 8), force);
    EXPECT_LT(force.colwise().sum().norm(), 1e-13);
    // Without the segment from the last nodes to the first, these would be pulled to one side only. In the round ring all nodes
    // of a chain are pulled equally towards the centre.
    force.setZero();
    ring.muscle(1).add_force(0, ring.rest, Points::Zero(ring.grid.size(), 3), force);
    for (int i = 0; i < 6; ++i) {
        const Vec3 inward = -Vec3(ring.rest(4 * i, 0), ring.rest(4 * i, 1), 0).normalized();
        EXPECT_NEAR(force.row(4 * i).dot(inward), force.row(0).norm(), 1e-12) << i;
    }
    EXPECT_GT(force.row(0).norm(), 1);
}

TEST(Musculotendon, ChainsShareTheOptimalLengthAsTheyShareTheLengthAtRest) {
    const Ring ring;
    const Eigen::VectorXd stretch = ring.muscle(1).stretch(ring.rest);
    EXPECT_NEAR(stretch.maxCoeff(), stretch.minCoeff(), 1e-12);
}

TEST(Musculotendon, RigidTendonsTieTheEndsToTheirAnchors) {
    MuscleParameters parameters = pennate(20);
    parameters.tendon = TendonModel::kRigid;
    const Points rest = belly();
    Anchors anchors = planar_anchors(kGrid, rest, 0.02);
    anchors.insertion.motion = [](double t_s) {
        return Rigid(Eigen::Translation3d(0, 0, 2 * t_s * t_s) *
                     Eigen::AngleAxisd(0.1 * t_s, Vec3::UnitX()));
    };
    const Musculotendon m(parameters, zajac_curves(), kGrid, rest, anchors, always(0.7));
    const std::vector<int> tied = m.tied_nodes();
    ASSERT_EQ(tied.size(), 18U);
    EXPECT_EQ(tied[0], 0);
    EXPECT_EQ(tied[9], 27);
    Points x = stretched(), v = zeros();
    m.place_tied(0.3, x, v);
    EXPECT_EQ(x.topRows(9), rest.topRows(9));
    // The distance from its point of the plate is that of the rest shape, and it moves with the plate.
    const Points plate = m.anchor_points(End::kInsertion, 0.3);
    for (int c = 0; c < 9; ++c) EXPECT_NEAR((plate.row(c) - x.row(27 + c)).norm(), 0.01, 1e-15);
    EXPECT_NEAR(v(27 + 4, 2), 1.2, 1e-7);
    const solve::ImplicitStep step{0.1, kInfinite, x};
    testing_of::expect_gradient_of_potential(m, step, x, 1e-8, 1e-5);
    testing_of::expect_hessian_of_potential(m, step, x, 1e-8, 1e-5);
    // The force on the anchors is that of the fibres on the tied nodes.
    Points force = zeros();
    m.add_force(0, x, zeros(), force);
    EXPECT_LT((m.anchor_forces(End::kOrigin, 0, x) - force.topRows(9)).cwiseAbs().maxCoeff(),
              1e-12);
    EXPECT_LT((m.anchor_forces(End::kInsertion, 0, x) - force.bottomRows(9)).cwiseAbs().maxCoeff(),
              1e-12);
}

TEST(Musculotendon, OneAnchoredEndHasTheWholeTendon) {
    const Points rest = belly();
    const Anchors anchors{planar_anchor(End::kOrigin, kGrid, rest, 0.02), {}};
    const Musculotendon m(kPrototype, zajac_curves(), kGrid, rest, anchors, always(0));
    Points x = rest;
    EXPECT_LT(m.anchor_pull(End::kOrigin, 0, x).norm(), 1e-9);
    x.col(0).array() += 0.02 * 0.033;
    EXPECT_NEAR(m.anchor_pull(End::kOrigin, 0, x).x(), 94.2, 1e-9);
    EXPECT_EQ(m.anchor_points(End::kInsertion, 0).rows(), 0);
}

TEST(Musculotendon, BonesHoldTendonsByOnePointALineOrOneEach) {
    const Points rest = belly();
    Points bone(1, 3);
    bone << -0.02, 0.001, 0;
    const Anchor one = bone_anchor(End::kOrigin, kGrid, rest, bone);
    for (int c = 0; c < 9; ++c) {
        EXPECT_EQ(one.rest.row(c), bone.row(0));
        EXPECT_NEAR(one.slack_m[c], (rest.row(c) - bone.row(0)).norm(), 1e-15);
    }
    bone.resize(2, 3);
    bone << -0.02, -0.01, 0, -0.02, 0.01, 0;
    const Anchor line = bone_anchor(End::kOrigin, kGrid, rest, bone);
    for (int n = 0; n < 3; ++n)
        for (int o = 0; o < 3; ++o) EXPECT_NEAR(line.rest(3 * n + o, 1), 0.01 * (n - 1), 1e-15);
    // Slack in the rest shape, in whatever direction each tendon goes.
    const Musculotendon m(
        kPrototype, zajac_curves(), kGrid, rest,
        {line, bone_anchor(End::kInsertion, kGrid, rest, rest.bottomRows(9).array() + 0.01)},
        always(0));
    EXPECT_LT(m.anchor_forces(End::kOrigin, 0, rest).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(m.anchor_forces(End::kInsertion, 0, rest).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_THROW(bone_anchor(End::kOrigin, kGrid, rest, Points(0, 3)), std::invalid_argument);
}

std::string message_of(const MuscleParameters& parameters) {
    try {
        check(parameters, "muscle.json:/muscle");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Musculotendon, ParametersOutsideTheirRangesAreRefusedByName) {
    EXPECT_EQ(message_of(kPrototype), "");
    MuscleParameters p = kPrototype;
    p.f0_n = -1;
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/f0_n: expected (0, inf), found -1");
    p = kPrototype;
    p.optimal_length_m = 0;
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/optimal_length_m: expected (0, inf), found 0");
    p = kPrototype;
    p.tendon_slack_m = kInfinite;
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/tendon_slack_m: expected [0, inf), found inf");
    p.tendon_slack_m = 0;
    EXPECT_EQ(message_of(p), "");
    try {
        muscle(p, 0);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "muscle/tendon_slack_m: expected (0, inf) of elastic tendons, found 0");
    }
    p = kPrototype;
    p.max_speed_hz = std::nan("");
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/greatest_speed_hz: expected (0, inf), found nan");
    p = kPrototype;
    p.pennation_deg = 90;
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/pennation_deg: expected [0, 90), found 90");
    p = kPrototype;
    p.damping = -0.1;
    EXPECT_EQ(message_of(p), "muscle.json:/muscle/damping: expected [0, inf), found -0.1");
}

MuscleParameters read(const char* json) {
    return read_muscle_parameters(
        JsonCursor::from_json({{"muscle", Json::parse(json)}}, "head.json").at("muscle"));
}

TEST(Musculotendon, ParametersAreReadWithDefaultsForSpeedPennationAndDamping) {
    const MuscleParameters p =
        read(R"({"f0_n": 50, "optimal_length_m": 0.06, "tendon_slack_m": 0.03})");
    EXPECT_EQ(p.f0_n, 50);
    EXPECT_EQ(p.optimal_length_m, 0.06);
    EXPECT_EQ(p.tendon_slack_m, 0.03);
    EXPECT_EQ(p.max_speed_hz, 10);
    EXPECT_EQ(p.pennation_deg, 0);
    EXPECT_EQ(p.damping, 0.05);
    EXPECT_EQ(read(R"({"f0_n": 50, "optimal_length_m": 0.06, "tendon_slack_m": 0.03,
                       "greatest_speed_hz": 4, "pennation_deg": 20, "damping": 0.1})")
                  .pennation_deg,
              20);
    try {
        read(R"({"f0_n": -2, "optimal_length_m": 0.06, "tendon_slack_m": 0.03})");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "head.json:/muscle/f0_n: expected (0, inf), found -2");
    }
}

TEST(Musculotendon, ArraysOfWrongSizeAreRefused) {
    const Points rest = belly();
    Anchors anchors = planar_anchors(kGrid, rest, 0.02);
    EXPECT_THROW(Musculotendon(kPrototype, zajac_curves(), {5, 3, 3}, rest, anchors, always(0)),
                 std::invalid_argument);
    EXPECT_THROW(
        Musculotendon(kPrototype, zajac_curves(), {4, 3, 3, true}, rest, anchors, always(0)),
        std::invalid_argument);
    anchors.origin.rest.conservativeResize(4, 3);
    EXPECT_THROW(Musculotendon(kPrototype, zajac_curves(), kGrid, rest, anchors, always(0)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
