// The musculotendon's forces: laws, derivatives against differences, pennation, and what is refused.

#include "muscle/musculotendon.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/error.h"
#include "core/json_cursor.h"
#include "tissue/grid_shape.h"

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

/// Stretched by 12 % so that fibres and tendons all pull, and disordered.
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
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
        EXPECT_GT(eigen.eigenvalues().maxCoeff(), 1e4);
        EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
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
        // Tendons are slack at rest, so the end nodes feel the fibres alone.
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
    // One segment longer, one shorter, same length of the chain: same tension in both.
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
    p = kPrototype;
    p.greatest_speed_hz = std::nan("");
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
    EXPECT_EQ(p.greatest_speed_hz, 10);
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
    anchors.origin.rest.conservativeResize(4, 3);
    EXPECT_THROW(Musculotendon(kPrototype, zajac_curves(), kGrid, rest, anchors, always(0)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
