// SPDX-License-Identifier: MIT
#include "risorius/solve/bounded_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace risorius::solve {
namespace {

Eigen::MatrixXd matrix_of(const CurveQuadratic& q) {
    const long n = q.b.size();
    Eigen::MatrixXd A = q.diagonal.asDiagonal();
    for (long i = 0; i + 1 < n; ++i) A(i, i + 1) = A(i + 1, i) = q.first[i];
    for (long i = 0; i + 2 < n; ++i) A(i, i + 2) = A(i + 2, i) = q.second[i];
    return A;
}

CurveQuadratic random_problem(std::mt19937& random, long n, bool bounded) {
    std::uniform_real_distribution<double> unit(0, 1);
    CurveQuadratic q(n);
    q.bend(1);
    for (long i = 0; i < n; ++i) q.pull(i, 10 * unit(random) - 5, unit(random) < 0.2 ? 0.1 : 1e-4);
    if (bounded)
        for (long i = 0; i < n; ++i) {
            if (unit(random) < 0.4) q.min[i] = -3 * unit(random);
            if (unit(random) < 0.4) q.max[i] = 1 * unit(random);
        }
    return q;
}

TEST(BoundedCurve, WithoutBoundsItIsTheSolutionOfTheEquations) {
    std::mt19937 random(1);
    const CurveQuadratic q = random_problem(random, 60, false);
    const CurveSolution solution = minimise(q);
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.rounds, 1);
    const Eigen::VectorXd expected = matrix_of(q).ldlt().solve(q.b);
    // The condition of the matrix is about 1e6.
    EXPECT_LT((solution.x - expected).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(BoundedCurve, HoldsTheConditionsOfAMinimumUnderRandomBounds) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 60; ++trial) {
        const CurveQuadratic q = random_problem(random, 80, true);
        const CurveSolution solution = minimise(q);
        EXPECT_TRUE(solution.converged);
        EXPECT_LT(solution.rounds, 400);
        const Eigen::VectorXd slope = matrix_of(q) * solution.x - q.b;
        for (long i = 0; i < solution.x.size(); ++i) {
            EXPECT_GE(solution.x[i], q.min[i]);
            EXPECT_LE(solution.x[i], q.max[i]);
            // Free: no slope. At a bound: it would go on beyond it.
            if (solution.x[i] > q.min[i] + 1e-9) {
                EXPECT_LT(slope[i], 1e-5);
            }
            if (solution.x[i] < q.max[i] - 1e-9) {
                EXPECT_GT(slope[i], -1e-5);
            }
        }
    }
}

TEST(BoundedCurve, EqualBoundsFixAnUnknown) {
    CurveQuadratic q(5);
    q.bend(1);
    for (long i = 0; i < 5; ++i) q.pull(i, 0, 1e-6);
    q.min[0] = q.max[0] = 1;
    q.min[4] = q.max[4] = 5;
    const CurveSolution solution = minimise(q);
    EXPECT_TRUE(solution.converged);
    for (long i = 0; i < 5; ++i) EXPECT_NEAR(solution.x[i], 1 + static_cast<double>(i), 1e-4);
}

}  // namespace
}  // namespace risorius::solve
