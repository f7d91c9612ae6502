// SPDX-License-Identifier: MIT
// Least squares in a box with an L1 weight, against the conditions of its minimum and cases with a known solution.
#include "risorius/solve/box_quadratic.h"

#include <gtest/gtest.h>

namespace risorius::solve {
namespace {

BoxQuadratic random_problem(int unknowns, unsigned seed) {
    std::srand(seed);
    const Eigen::MatrixXd J = Eigen::MatrixXd::Random(2 * unknowns, unknowns);
    BoxQuadratic problem;
    problem.A = J.transpose() * J;
    problem.b = 3 * Eigen::VectorXd::Random(unknowns);
    problem.l1_weight = Eigen::VectorXd::Constant(unknowns, 0.2);
    problem.min = Eigen::VectorXd::Constant(unknowns, -0.3);
    problem.max = Eigen::VectorXd::Constant(unknowns, 0.4);
    return problem;
}

TEST(BoxQuadratic, WithoutLimitsAndPriceItSolvesTheEquations) {
    BoxQuadratic problem = random_problem(12, 1);
    problem.l1_weight.setZero();
    problem.min.setConstant(-1e3);
    problem.max.setConstant(1e3);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(12);
    minimise(problem, x, 1e-13);
    EXPECT_LT((problem.A * x + problem.b).norm(), 1e-9);
}

TEST(BoxQuadratic, AtTheMinimumNoUnknownCanMoveForTheBetter) {
    for (unsigned seed = 1; seed < 6; ++seed) {
        const BoxQuadratic problem = random_problem(20, seed);
        Eigen::VectorXd x = Eigen::VectorXd::Constant(20, 10);
        minimise(problem, x, 1e-13);
        const Eigen::VectorXd slope = problem.A * x + problem.b;
        int free = 0, zero = 0, held = 0;
        for (long i = 0; i < 20; ++i) {
            ASSERT_GE(x[i], problem.min[i]);
            ASSERT_LE(x[i], problem.max[i]);
            // Slopes to either side, with the L1 weight.
            const double up = slope[i] + (x[i] >= 0 ? 1 : -1) * problem.l1_weight[i];
            const double down = slope[i] + (x[i] > 0 ? 1 : -1) * problem.l1_weight[i];
            if (x[i] < problem.max[i]) {
                EXPECT_GE(up, -1e-8);
            }
            if (x[i] > problem.min[i]) {
                EXPECT_LE(down, 1e-8);
            }
            const bool at_limit = x[i] == problem.min[i] || x[i] == problem.max[i];
            ++(at_limit ? held : x[i] == 0 ? zero : free);
        }
        EXPECT_GT(free, 0);
        EXPECT_GT(held, 0);
    }
}

TEST(BoxQuadratic, UnknownsThatAreNearlyAlikeTakeFewSweeps) {
    // Sweeps alone would take thousands: each covers a thousandth of the remaining distance.
    std::srand(7);
    const Eigen::VectorXd shared = Eigen::VectorXd::Random(40);
    const Eigen::MatrixXd J =
        shared * Eigen::RowVectorXd::Ones(8) + 0.03 * Eigen::MatrixXd::Random(40, 8);
    BoxQuadratic problem = random_problem(8, 1);
    problem.A = J.transpose() * J;
    problem.b = -J.transpose() * (J * Eigen::VectorXd::LinSpaced(8, 0.05, 0.35));
    problem.l1_weight.setConstant(1e-4);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(8);
    EXPECT_LT(minimise(problem, x, 1e-9), 60);
    const Eigen::VectorXd slope = problem.A * x + problem.b;
    for (long i = 0; i < 8; ++i)
        if (x[i] > 0 && x[i] < problem.max[i]) {
            EXPECT_NEAR(slope[i], -problem.l1_weight[i], 1e-9) << i;
        }
}

TEST(BoxQuadratic, APriceAboveTheSlopeKeepsAnUnknownAtZero) {
    BoxQuadratic problem;
    problem.A = Eigen::MatrixXd::Identity(2, 2);
    problem.b = Eigen::Vector2d(-0.5, -0.5);
    problem.l1_weight = Eigen::Vector2d(0.6, 0.2);
    problem.min = Eigen::Vector2d(-1, -1);
    problem.max = Eigen::Vector2d(1, 1);
    Eigen::VectorXd x = Eigen::Vector2d(1, 1);
    minimise(problem, x);
    EXPECT_EQ(x[0], 0.0);
    EXPECT_DOUBLE_EQ(x[1], 0.3);
}

}  // namespace
}  // namespace risorius::solve
