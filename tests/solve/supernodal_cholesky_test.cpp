// SPDX-License-Identifier: MIT
#include "risorius/solve/supernodal_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <random>
#include <thread>

namespace risorius::solve {
namespace {

/// A box of nodes, each joined to its neighbours by 3 x 3 blocks. The matrix is symmetric and, with `weight` > 0, positive
/// definite.
Eigen::SparseMatrix<double> box(int nx, int ny, int nz, double weight) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Eigen::Triplet<double>> entries;
    const auto at = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
    const int n = 3 * nx * ny * nz;
    Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(n, weight);
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                for (const auto& [di, dj, dk] : {std::array{1, 0, 0}, std::array{0, 1, 0},
                                                 std::array{0, 0, 1}, std::array{1, 1, 0}}) {
                    if (i + di >= nx || j + dj >= ny || k + dk >= nz) continue;
                    const int a = at(i, j, k), b = at(i + di, j + dj, k + dk);
                    for (int r = 0; r < 3; ++r)
                        for (int c = 0; c < 3; ++c) {
                            const double v = uniform(random);
                            entries.emplace_back(3 * b + r, 3 * a + c, v);
                            diagonal[3 * b + r] += std::abs(v);
                            diagonal[3 * a + c] += std::abs(v);
                        }
                }
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i]);
    for (int a = 0; a < n / 3; ++a)
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < r; ++c) entries.emplace_back(3 * a + r, 3 * a + c, 0.0);
    Eigen::SparseMatrix<double> out(n, n);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

Eigen::VectorXd some_right(int n) { return Eigen::VectorXd::LinSpaced(n, -1, 2); }

TEST(SupernodalCholesky, SolvesWhatItFactored) {
    SupernodalCholesky factor;
    // The last one has panels wider than a block of the dense kernel, and edges that do not fill a tile.
    for (const auto& [nx, ny, nz] :
         {std::array{1, 1, 1}, std::array{5, 3, 2}, std::array{9, 8, 7}}) {
        const Eigen::SparseMatrix<double> A = box(nx, ny, nz, 0.1);
        ASSERT_TRUE(factor.factorise(A, 3));
        const Eigen::VectorXd b = some_right(static_cast<int>(A.rows()));
        Eigen::VectorXd x = b;
        factor.solve(x.data(), x.data());
        const Eigen::VectorXd back = A.selfadjointView<Eigen::Lower>() * x;
        EXPECT_LT((back - b).norm(), 1e-12 * b.norm()) << nx;
    }
    EXPECT_EQ(factor.orderings(), 3);
}

TEST(SupernodalCholesky, GivesTheSameBitsBesideOthers) {
    const Eigen::SparseMatrix<double> A = box(12, 11, 10, 0.1);
    const auto solution = [&] {
        SupernodalCholesky factor;
        EXPECT_TRUE(factor.factorise(A, 3));
        Eigen::VectorXd x = some_right(static_cast<int>(A.rows()));
        factor.solve(x.data(), x.data());
        return x;
    };
    const Eigen::VectorXd alone = solution();
    std::array<Eigen::VectorXd, 4> beside;
    std::vector<std::thread> threads;
    for (Eigen::VectorXd& one : beside)
        threads.emplace_back([&] {
            for (int again = 0; again < 3; ++again) one = solution();
        });
    for (std::thread& thread : threads) thread.join();
    for (const Eigen::VectorXd& one : beside) EXPECT_EQ((one - alone).lpNorm<Eigen::Infinity>(), 0);
}

TEST(SupernodalCholesky, OrdersAnewOnlyWhenThePatternIsNew) {
    SupernodalCholesky factor;
    Eigen::SparseMatrix<double> A = box(4, 4, 4, 0.1);
    ASSERT_TRUE(factor.factorise(A, 3));
    A *= 2;
    ASSERT_TRUE(factor.factorise(A, 3));
    EXPECT_EQ(factor.orderings(), 1);
    const Eigen::VectorXd b = some_right(static_cast<int>(A.rows()));
    Eigen::VectorXd x(b.size());
    factor.solve(b.data(), x.data());
    EXPECT_LT((A.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-12 * b.norm());
}

TEST(SupernodalCholesky, InSinglePrecisionIsAMetricOfThePrecisionOfAFloat) {
    SupernodalCholesky factor;
    const Eigen::SparseMatrix<double> A = box(9, 8, 7, 0.1);
    ASSERT_TRUE(factor.factorise(A, 3, Precision::kSingle));
    const Eigen::VectorXd b = some_right(static_cast<int>(A.rows()));
    Eigen::VectorXd x = b;
    factor.solve(x.data(), x.data());
    Eigen::VectorXd left = b - A.selfadjointView<Eigen::Lower>() * x;
    EXPECT_LT(left.norm(), 1e-5 * b.norm());
    EXPECT_GT(left.norm(), 1e-12 * b.norm()) << "this was double precision";
    // A step of refinement squares the error
    Eigen::VectorXd more(b.size());
    factor.solve(left.data(), more.data());
    left = b - A.selfadjointView<Eigen::Lower>() * (x + more);
    EXPECT_LT(left.norm(), 1e-10 * b.norm());

    ASSERT_TRUE(factor.factorise(A, 3));
    EXPECT_EQ(factor.orderings(), 1);
    factor.solve(b.data(), x.data());
    EXPECT_LT((A.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-12 * b.norm());
}

TEST(SupernodalCholesky, KeepsAGivenOrderForOtherPatterns) {
    SupernodalCholesky factor;
    const Eigen::SparseMatrix<double> A = box(6, 5, 4, 0.1);
    factor.order_like(A, 3);
    Eigen::SparseMatrix<double> more = A;
    const int last = static_cast<int>(A.rows()) - 3;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) more.coeffRef(last + r, c) = 1e-3 * (r + c);
    more.makeCompressed();
    for (const Eigen::SparseMatrix<double>& one : {A, more, A}) {
        ASSERT_TRUE(factor.factorise(one, 3));
        const Eigen::VectorXd b = some_right(static_cast<int>(A.rows()));
        Eigen::VectorXd x(b.size());
        factor.solve(b.data(), x.data());
        EXPECT_LT((one.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-12 * b.norm());
    }
    EXPECT_EQ(factor.orderings(), 1);
}

TEST(SupernodalCholesky, RefusesWhatIsNotPositiveDefinite) {
    SupernodalCholesky factor;
    Eigen::SparseMatrix<double> A = box(4, 3, 3, 0.1);
    A.coeffRef(40, 40) = -1e-3;
    EXPECT_FALSE(factor.factorise(A, 3));
    A.coeffRef(40, 40) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(factor.factorise(A, 3));
    EXPECT_TRUE(factor.factorise(box(4, 3, 3, 0.1), 3));
}

}  // namespace
}  // namespace risorius::solve
