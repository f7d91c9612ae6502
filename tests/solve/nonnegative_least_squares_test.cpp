// SPDX-License-Identifier: MIT
#include "risorius/solve/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <random>

namespace risorius::solve {
namespace {

Eigen::MatrixXd random_matrix(std::mt19937& random, long rows, long cols) {
    std::normal_distribution<double> normal;
    Eigen::MatrixXd out(rows, cols);
    for (long i = 0; i < rows; ++i)
        for (long j = 0; j < cols; ++j) out(i, j) = normal(random);
    return out;
}

TEST(NonnegativeLeastSquares, HoldsTheConditionsOfAMinimum) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 30; ++trial) {
        const Eigen::MatrixXd B = random_matrix(random, 7, 120);
        const Eigen::VectorXd y = 3 * random_matrix(random, 7, 1),
                              cost = random_matrix(random, 120, 1).cwiseAbs();
        const double ridge = 0.02;
        Eigen::VectorXd state;
        const Eigen::VectorXd w = nonnegative_least_squares(B, y, cost, ridge, state);
        const Eigen::VectorXd slope = B.transpose() * (B * w - y) + ridge * w + cost;
        EXPECT_GE(w.minCoeff(), 0);
        EXPECT_GT((w.array() > 0).count(), 0);
        for (long i = 0; i < w.size(); ++i) {
            EXPECT_GT(slope[i], -1e-7);
            if (w[i] > 0) {
                EXPECT_NEAR(slope[i], 0, 1e-7);
            }
        }
    }
}

TEST(NonnegativeLeastSquares, AWarmStartGivesTheSameSolution) {
    std::mt19937 random(4);
    const Eigen::MatrixXd B = random_matrix(random, 6, 80);
    const Eigen::VectorXd cost = Eigen::VectorXd::Zero(80);
    Eigen::VectorXd warm;
    for (int i = 0; i < 10; ++i) {
        const Eigen::VectorXd y = random_matrix(random, 6, 1);
        Eigen::VectorXd cold;
        const Eigen::VectorXd one = nonnegative_least_squares(B, y, cost, 0.05, warm),
                              two = nonnegative_least_squares(B, y, cost, 0.05, cold);
        EXPECT_LT((one - two).cwiseAbs().maxCoeff(), 1e-7);
    }
}

}  // namespace
}  // namespace risorius::solve
