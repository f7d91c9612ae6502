// SPDX-License-Identifier: MIT
#include "risorius/core/dense_algebra.h"

#include <gtest/gtest.h>

namespace risorius {
namespace {

/// A symmetric matrix with the given eigenvalues, rotated by 3-4-5 angles, so that its entries are exact.
Eigen::MatrixXd turned(const Vec3& values) {
    Eigen::MatrixXd a(3, 3), b(3, 3);
    a << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
    b << 1, 0, 0, 0, 0.6, -0.8, 0, 0.8, 0.6;
    const Eigen::MatrixXd turn = a * b;
    return turn * values.asDiagonal() * turn.transpose();
}

TEST(DenseAlgebra, ASymmetricMatrixIsTheSumOfItsModes) {
    const Eigen::MatrixXd m = turned({2, -1, 5});
    const SymmetricEigen modes = symmetric_eigen(m);
    EXPECT_LT((modes.values - Vec3(-1, 2, 5)).norm(), 1e-14);
    EXPECT_LT((symmetric_eigenvalues(m) - modes.values).norm(), 1e-14);
    EXPECT_LT((m * modes.vectors - modes.vectors * modes.values.asDiagonal()).norm(), 1e-14);
}

TEST(DenseAlgebra, ThePositivePartLeavesOutWhatIsNegative) {
    EXPECT_LT((positive_part(turned({2, -1, 5})) - turned({2, 0, 5})).norm(), 1e-14);
}

TEST(DenseAlgebra, ATurnHasComplexEigenvalues) {
    Eigen::MatrixXd quarter(2, 2);
    quarter << 0, -1, 1, 0;
    const auto values = eigenvalues(quarter);
    ASSERT_EQ(values.size(), 2u);
    EXPECT_LT(std::abs(values[0] + values[1]), 1e-15);
    EXPECT_LT(std::abs(values[0] * values[1] - 1.0), 1e-15);
    EXPECT_LT(std::abs(std::abs(values[0].imag()) - 1), 1e-15);
}

TEST(DenseAlgebra, EquationsAreSolved) {
    const Eigen::MatrixXd m = turned({2, -1, 5});
    const Eigen::VectorXd right = Vec3(1, 2, 3);
    EXPECT_LT((m * solved_for(m, right) - right).norm(), 1e-14);
    EXPECT_LT((m * solved_symmetric(m, right) - right).norm(), 1e-14);
    EXPECT_LT((m * inverse_of(m) - Mat3::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace risorius
