// SPDX-License-Identifier: MIT
#include "risorius/solve/sparse_cholesky.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "risorius/core/dense_algebra.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
namespace {

/// A grid of springs with some long ones across it, in which every node is held weakly; lower triangle.
Eigen::SparseMatrix<double> spring_grid(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> weight(0.1, 10.0);
    std::uniform_int_distribution<int> any(0, n * n - 1);
    MetricBuilder builder(n * n);
    const double c[2] = {1, -1};
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int right[2] = {j * n + i, j * n + i + 1};
            const int up[2] = {j * n + i, j * n + i + n};
            if (i + 1 < n) builder.add_outer(right, c, 2, weight(random));
            if (j + 1 < n) builder.add_outer(up, c, 2, weight(random));
            builder.add_diagonal(j * n + i, 0.01);
        }
        const int across[2] = {any(random), any(random)};
        builder.add_outer(across, c, 2, weight(random));
    }
    return builder.build({});
}

Points random_points(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Points x(n, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = uniform(random);
    return x;
}

TEST(SparseCholesky, AgreesWithADenseFactor) {
    for (const int n : {1, 2, 3, 7, 15}) {
        const Eigen::SparseMatrix<double> a = spring_grid(n, 1);
        const SparseCholesky factor(a);
        const Points b = random_points(n * n, 2);
        Points x;
        factor.solve(b, x);
        Eigen::MatrixXd dense = a;
        dense = Eigen::MatrixXd(dense.selfadjointView<Eigen::Lower>());
        const Eigen::MatrixXd expected = solved_for(dense, b);
        // The condition number is about 1e4 and rounding 1e-16.
        EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff())
            << "n = " << n;
        EXPECT_EQ(factor.size(), n * n);
        EXPECT_GE(factor.nonzeros(), n * n);
    }
}

TEST(SparseCholesky, GivesTheSameBitsTwice) {
    const Eigen::SparseMatrix<double> a = spring_grid(20, 3);
    const SparseCholesky one(a), other(a);
    const Points b = random_points(400, 4);
    Points x, y, z;
    one.solve(b, x);
    one.solve(random_points(400, 5), y);  // leaves other numbers in the scratch arrays
    one.solve(b, y);
    other.solve(b, z);
    EXPECT_TRUE((x.array() == y.array()).all());
    EXPECT_TRUE((x.array() == z.array()).all());
}

TEST(SparseCholesky, SolvesInPlace) {
    const SparseCholesky factor(spring_grid(9, 6));
    const Points b = random_points(81, 7);
    Points x, y = b;
    factor.solve(b, x);
    factor.solve(y, y);
    EXPECT_TRUE((x.array() == y.array()).all());
}

TEST(SparseCholesky, RefusesAMatrixThatIsNotPositiveDefinite) {
    MetricBuilder builder(3);
    builder.add_diagonal(0, 1.0);
    builder.add_diagonal(1, -1.0);
    builder.add_diagonal(2, 1.0);
    try {
        SparseCholesky factor(builder.build({}));
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "SparseCholesky: the matrix is not positive definite");
    }
}

TEST(MetricBuilder, ASpringIsItsStiffnessMatrix) {
    MetricBuilder builder(3);
    const int nodes[2] = {2, 0};
    const double c[2] = {1, -1};
    builder.add_outer(nodes, c, 2, 5.0);
    const Eigen::MatrixXd lower = builder.build({});
    Eigen::Matrix3d expected;
    expected << 5, 0, 0, 0, 0, 0, -5, 0, 5;
    EXPECT_TRUE(lower.isApprox(expected));
}

TEST(MetricBuilder, ANodeListedTwiceCountsWithItsSum) {
    MetricBuilder twice(2), once(2);
    const int nodes[3] = {0, 1, 0}, merged[2] = {0, 1};
    const double c[3] = {0.5, -1, 0.25}, sum[2] = {0.75, -1};
    twice.add_outer(nodes, c, 3, 2.0);
    once.add_outer(merged, sum, 2, 2.0);
    EXPECT_TRUE(Eigen::MatrixXd(twice.build({})).isApprox(Eigen::MatrixXd(once.build({}))));
}

TEST(MetricBuilder, FixedNodesBecomeRowsOfTheIdentity) {
    MetricBuilder builder(3);
    const int nodes[3] = {0, 1, 2};
    const double c[3] = {1, 1, 1};
    builder.add_outer(nodes, c, 3, 4.0);
    const Eigen::MatrixXd lower = builder.build({0, 1, 0});
    Eigen::Matrix3d expected;
    expected << 4, 0, 0, 0, 1, 0, 4, 0, 4;
    EXPECT_TRUE(lower.isApprox(expected));
}

TEST(MetricBuilder, ABlockIsAddedOnceHoweverItsNodesAreOrdered) {
    MetricBuilder builder(3);
    const int nodes[2] = {2, 1};
    const double block[4] = {3, -9, -1, 2};  // the upper triangle is not read
    builder.add_block(nodes, block, 2);
    const Eigen::MatrixXd lower = builder.build({});
    Eigen::Matrix3d expected;
    expected << 0, 0, 0, 0, 2, 0, 0, -1, 3;
    EXPECT_TRUE(lower.isApprox(expected));
}

TEST(SparseCholesky, AFactorKeptInFloatSolvesToAHundredThousandth) {
    const Eigen::SparseMatrix<double> a = spring_grid(12, 5);
    const Points b = random_points(144, 6);
    Points exact, single;
    SparseCholesky(a).solve(b, exact);
    SparseCholesky(a, Precision::kSingle).solve(b, single);
    EXPECT_LT((single - exact).norm(), 1e-5 * exact.norm());
    EXPECT_GT((single - exact).norm(), 0.0);
}

}  // namespace
}  // namespace risorius::solve
