// A Laplacian applied to points against the matrix it was made from.
#include "solve/laplacian.h"

#include <gtest/gtest.h>

#include "solve/metric_builder.h"

namespace risorius::solve {
namespace {

// A chain of springs with one across
Eigen::SparseMatrix<double> springs(int nodes) {
    MetricBuilder builder(nodes);
    const double ends[2] = {1, -1};
    for (int i = 0; i + 1 < nodes; ++i) {
        const int pair[2] = {i, i + 1};
        builder.add_outer(pair, ends, 2, 2.0 + i);
    }
    const int across[2] = {0, nodes - 1};
    builder.add_outer(across, ends, 2, 0.5);
    return builder.build({});
}

TEST(Laplacian, PullsAsItsMatrixDoes) {
    const Eigen::SparseMatrix<double> lower = springs(9);
    const Eigen::MatrixXd below = Eigen::MatrixXd(lower).triangularView<Eigen::StrictlyLower>();
    const Eigen::MatrixXd full = Eigen::MatrixXd(lower) + below.transpose();
    const Points x = Points::Random(9, 3), y = Points::Random(9, 3);
    Points gradient;
    const double energy = Laplacian(lower).pull(3.0, x, y, gradient);
    const Eigen::MatrixXd expected = 3.0 * full * (x - y);
    EXPECT_LT((gradient - expected).norm(), 1e-6 * expected.norm());
    EXPECT_NEAR(energy, 0.5 * (x - y).cwiseProduct(expected).sum(), 1e-6 * energy);
}

TEST(Laplacian, WhatMovesAsOneCostsNothing) {
    const Points x = Points::Random(9, 3);
    Points y = x;
    y.rowwise() += Eigen::RowVector3d(0.25, -0.5, 1);  // kept by float
    Points gradient;
    EXPECT_NEAR(Laplacian(springs(9)).pull(3.0, y, x, gradient), 0, 1e-10);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-5);
}

}  // namespace
}  // namespace risorius::solve
