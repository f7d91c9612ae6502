// SPDX-License-Identifier: MIT
#include "risorius/solve/quasi_newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
namespace {

/// Flags of a chain of n nodes from the origin along x, with node 0 fixed.
std::vector<char> first_fixed(int n) {
    std::vector<char> fixed(static_cast<std::size_t>(n), 0);
    fixed[0] = 1;
    return fixed;
}

SparseCholesky chain_metric(int n, double stiffness) {
    MetricBuilder builder(n);
    const double c[2] = {-1, 1};
    for (int i = 0; i + 1 < n; ++i) {
        const int nodes[2] = {i, i + 1};
        builder.add_outer(nodes, c, 2, stiffness);
    }
    return SparseCholesky(builder.build(first_fixed(n)));
}

// An energy whose last digits are noise that hides the decrease.
TEST(QuasiNewton, DoesNotLookForDecreasesThatRoundingHides) {
    const int n = 12;
    const SparseCholesky metric = chain_metric(n, 40);
    int calls = 0;
    const auto energy = [&](const Points& x, Points& gradient) {
        gradient.setZero();
        double e = 1e-9 * ++calls;
        for (int i = 0; i + 1 < n; ++i) {
            const Eigen::RowVector3d d = x.row(i + 1) - x.row(i);
            e += 20 * d.squaredNorm();
            gradient.row(i + 1) += 40 * d;
            gradient.row(i) -= 40 * d;
        }
        gradient.row(0).setZero();
        return e;
    };
    for (const double shortest_m : {0.0, 1e-9}) {
        Points x = Points::Zero(n, 3);
        for (int i = 0; i < n; ++i) x(i, 0) = 1e-10 * i / n;
        const StepReport report =
            minimise(energy, metric, x, {.iterations = 1, .shortest_m = shortest_m});
        EXPECT_EQ(report.evaluations, shortest_m > 0 ? 2 : 14);
        EXPECT_TRUE(report.stalled);
    }
}

TEST(QuasiNewton, AQuadraticWithItsOwnHessianIsDoneInOneStep) {
    // Linear springs of zero rest length between neighbours, and a weight on every node.
    const int n = 12;
    const double k = 40;
    const SparseCholesky metric = chain_metric(n, k);
    const auto energy = [&](const Points& x, Points& gradient) {
        gradient.setZero();
        double e = 0;
        for (int i = 0; i + 1 < n; ++i) {
            const Eigen::RowVector3d d = x.row(i + 1) - x.row(i);
            e += 0.5 * k * d.squaredNorm() - 0.01 * x(i + 1, 1);
            gradient.row(i + 1) += k * d;
            gradient.row(i) -= k * d;
            gradient(i + 1, 1) -= 0.01;
        }
        gradient.row(0).setZero();
        return e;
    };
    Points x = Points::Zero(n, 3);
    for (int i = 0; i < n; ++i) x(i, 0) = 1e-3 * i;
    const StepReport report = minimise(energy, metric, x, {.iterations = 1, .step_cap_m = 1.0});
    EXPECT_EQ(report.iterations, 1);
    EXPECT_EQ(report.backtracks, 0);
    // The depth of node i is the sum, over the springs above it, of the weight they carry divided by k.
    double expected = 0;
    for (int i = 1; i < n; ++i) {
        expected += 0.01 * (n - i) / k;
        EXPECT_NEAR(x(i, 1), expected, 1e-14);
        EXPECT_NEAR(x(i, 0), 0.0, 1e-16);
    }
}

/// A hanging bar of links with the energy lambda L/4 (s^2 - 1)^2 each, s = length / L: the metric law in one dimension. A link
/// that carries T stretches to s^3 - s = T / lambda.
struct HangingBar {
    static constexpr int n = 9;
    static constexpr double length = 1e-2, lambda = 2.0, weight = 0.15;

    static double energy(const Points& x, Points& gradient) {
        gradient.setZero();
        double e = 0;
        for (int i = 0; i + 1 < n; ++i) {
            const Eigen::RowVector3d d = (x.row(i + 1) - x.row(i)) / length;
            const double strain = d.squaredNorm() - 1;
            e += lambda * length / 4 * strain * strain - weight * x(i + 1, 0);
            gradient.row(i + 1) += lambda * strain * d;
            gradient.row(i) -= lambda * strain * d;
            gradient(i + 1, 0) -= weight;
        }
        gradient.row(0).setZero();
        return e;
    }
    static Points rest() {
        Points x = Points::Zero(n, 3);
        for (int i = 0; i < n; ++i) x(i, 0) = length * i;
        return x;
    }
};

TEST(QuasiNewton, AStretchedBarReachesItsAnalyticLength) {
    Points x = HangingBar::rest();
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    const StepReport report =
        minimise(HangingBar::energy, metric, x, {.iterations = 100, .tolerance_rms_m = 1e-10});
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.iterations, 30);
    double expected = 0;
    for (int i = 1; i < HangingBar::n; ++i) {
        const double carried = HangingBar::weight * (HangingBar::n - i) / HangingBar::lambda;
        double s = 1.0;
        for (int newton = 0; newton < 50; ++newton)
            s -= (s * s * s - s - carried) / (3 * s * s - 1);
        expected += s * HangingBar::length;
        EXPECT_NEAR(x(i, 0), expected, 1e-9);
    }
    Points gradient(HangingBar::n, 3);
    EXPECT_EQ(report.energy_j, HangingBar::energy(x, gradient));
}

TEST(QuasiNewton, MemorySavesIterations) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    int iterations[2];
    for (int memory : {0, 6}) {
        Points x = HangingBar::rest();
        const StepReport report =
            minimise(HangingBar::energy, metric, x,
                     {.iterations = 1000, .memory = memory, .tolerance_rms_m = 1e-10});
        EXPECT_TRUE(report.converged);
        iterations[memory == 0 ? 0 : 1] = report.iterations;
    }
    EXPECT_LT(2 * iterations[1], iterations[0]);
}

TEST(QuasiNewton, PairsInFloatLeadToTheSamePlace) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    Points x[2];
    int iterations[2];
    for (const Precision pairs : {Precision::kDouble, Precision::kSingle}) {
        const int which = pairs == Precision::kSingle;
        x[which] = HangingBar::rest();
        const StepReport report =
            minimise(HangingBar::energy, metric, x[which],
                     {.iterations = 100, .pairs = pairs, .tolerance_rms_m = 1e-10});
        EXPECT_TRUE(report.converged);
        iterations[which] = report.iterations;
    }
    EXPECT_LT((x[0] - x[1]).norm(), 1e-9);
    EXPECT_NE(x[0], x[1]);
    EXPECT_LE(std::abs(iterations[0] - iterations[1]), 1);
}

TEST(QuasiNewton, EveryStepLowersTheEnergyAndStaysUnderTheCap) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 0.3 * HangingBar::lambda / HangingBar::length);
    Points x = HangingBar::rest(), gradient(HangingBar::n, 3);
    double last = HangingBar::energy(x, gradient);
    for (int step = 0; step < 8; ++step) {
        const Points before = x;
        const StepReport report =
            minimise(HangingBar::energy, metric, x, {.iterations = 1, .step_cap_m = 1e-3});
        EXPECT_LT(report.energy_j, last);
        EXPECT_LE((x - before).rowwise().norm().maxCoeff(), 1e-3 * (1 + 1e-12));
        last = report.energy_j;
    }
}

TEST(QuasiNewton, ATrustedLastStepIsTheSameToTheBitAndCostsNoEvaluation) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    Points checked = HangingBar::rest(), trusted = HangingBar::rest();
    const StepReport with_check = minimise(HangingBar::energy, metric, checked, {.iterations = 4});
    const StepReport without =
        minimise(HangingBar::energy, metric, trusted, {.iterations = 4, .trust_last = true});
    ASSERT_EQ(with_check.backtracks, 0);
    EXPECT_TRUE((checked.array() == trusted.array()).all());
    EXPECT_EQ(without.iterations, 4);
    EXPECT_EQ(without.evaluations, with_check.evaluations - 1);
    EXPECT_EQ(without.last_step_rms_m, with_check.last_step_rms_m);
}

TEST(QuasiNewton, ALastStepIsCheckedWhereOneBeforeItWentTooFar) {
    // The metric is much too soft: full steps go beyond the minimum and are halved.
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 0.05 * HangingBar::lambda / HangingBar::length);
    Points x = HangingBar::rest(), gradient(HangingBar::n, 3);
    const StepReport report = minimise(HangingBar::energy, metric, x,
                                       {.iterations = 3, .step_cap_m = 1.0, .trust_last = true});
    ASSERT_GT(report.backtracks, 0);
    EXPECT_EQ(report.evaluations, 1 + report.iterations + report.backtracks);
    EXPECT_EQ(report.energy_j, HangingBar::energy(x, gradient));
}

TEST(QuasiNewton, RestNeedsNoStep) {
    const SparseCholesky metric = chain_metric(4, 1.0);
    Points x = Points::Ones(4, 3);
    const StepReport report = minimise(
        [](const Points&, Points& gradient) {
            gradient.setZero();
            return 0.0;
        },
        metric, x, {});
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.iterations, 0);
    EXPECT_TRUE((x.array() == 1.0).all());
}

TEST(QuasiNewton, AnEnergyThatCannotBeLoweredIsReportedAsStalled) {
    const SparseCholesky metric = chain_metric(4, 1.0);
    Points x = Points::Ones(4, 3);
    const StepReport report = minimise(
        [](const Points& at, Points& gradient) {
            gradient.setConstant(1.0);
            gradient.row(0).setZero();
            return (at.array() == 1.0).all() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
        },
        metric, x, {});
    EXPECT_TRUE(report.stalled);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE((x.array() == 1.0).all());
}

TEST(QuasiNewton, FixedNodesStayWhereTheyAre) {
    Points x = HangingBar::rest();
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    minimise(HangingBar::energy, metric, x, {.iterations = 20});
    EXPECT_EQ(x.row(0).norm(), 0.0);
}

/// The loaded bar in equilibrium.
Points balanced_bar(const SparseCholesky& metric) {
    Points x = HangingBar::rest();
    minimise(HangingBar::energy, metric, x, {.iterations = 100, .tolerance_rms_m = 1e-12});
    return x;
}

TEST(QuasiNewton, ALikelyMoveThatLeadsDownhillIsTakenWithoutASolve) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    const Points moves[] = {balanced_bar(metric) - HangingBar::rest()};
    Points x = HangingBar::rest();
    QuasiNewton solver;
    const StepReport report = solver.minimise(
        HangingBar::energy, [](const Points&, Points&) { FAIL() << "solved"; }, x,
        {.iterations = 0}, moves);
    EXPECT_EQ(report.evaluations, 2);
    EXPECT_TRUE((x.array() == (HangingBar::rest() + moves[0]).array()).all());
    Points gradient(HangingBar::n, 3);
    EXPECT_EQ(report.energy_j, HangingBar::energy(x, gradient));
}

// On a quadratic, any move in the direction of the minimum shows how far it is, even with a metric that is ten times too stiff.
TEST(QuasiNewton, ALikelyMoveThatLeadsUphillIsLeftButItsCurvatureCounts) {
    const int n = 12;
    const double k = 40;
    const auto energy = [&](const Points& x, Points& gradient) {
        gradient.setZero();
        double e = 0;
        for (int i = 0; i + 1 < n; ++i) {
            const Eigen::RowVector3d d = x.row(i + 1) - x.row(i);
            e += 0.5 * k * d.squaredNorm();
            gradient.row(i + 1) += k * d;
            gradient.row(i) -= k * d;
        }
        gradient.row(0).setZero();
        return e;
    };
    const SparseCholesky metric = chain_metric(n, 10 * k);
    const InverseMetric inverse = [&](const Points& b, Points& y) { metric.solve(b, y); };
    Points start = Points::Zero(n, 3);  // at the minimum, all nodes are at the origin
    for (int i = 1; i < n; ++i) start.row(i) << 1e-3 * i, 1e-3 * std::sin(i), 0;
    QuasiNewton solver;
    const auto left_after = [&](int iterations, std::span<const Points> likely) {
        Points x = start;
        solver.minimise(energy, inverse, x, {.iterations = iterations, .step_cap_m = 1}, likely);
        return x.norm() / start.norm();
    };
    for (const double length : {-0.5, 3.0}) {
        const Points moves[] = {-length * start};
        EXPECT_EQ(left_after(0, moves), 1.0) << length;
        EXPECT_LT(left_after(1, moves), 1e-12) << length;
    }
    EXPECT_GT(left_after(1, {}), 0.5);
}

TEST(QuasiNewton, ALikelyMoveThatIsNotANumberDoesNoHarm) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    const InverseMetric inverse = [&](const Points& b, Points& y) { metric.solve(b, y); };
    const Points moves[] = {
        Points::Constant(HangingBar::n, 3, std::numeric_limits<double>::quiet_NaN())};
    Points x = HangingBar::rest(), plain = x;
    QuasiNewton solver;
    solver.minimise(HangingBar::energy, inverse, x, {.iterations = 5}, moves);
    solver.minimise(HangingBar::energy, inverse, plain, {.iterations = 5});
    EXPECT_TRUE((x.array() == plain.array()).all());
}

TEST(QuasiNewton, ReusedBuffersLeaveNoTrace) {
    const SparseCholesky metric =
        chain_metric(HangingBar::n, 2 * HangingBar::lambda / HangingBar::length);
    QuasiNewton used;
    Points warm = HangingBar::rest() * 1.7;
    used.minimise(HangingBar::energy, metric, warm, {.iterations = 9});
    Points a = HangingBar::rest(), b = HangingBar::rest();
    used.minimise(HangingBar::energy, metric, a, {.iterations = 7});
    minimise(HangingBar::energy, metric, b, {.iterations = 7});
    EXPECT_TRUE((a.array() == b.array()).all());
}

}  // namespace
}  // namespace risorius::solve
