// SPDX-License-Identifier: MIT
/// \file
/// Second derivatives that energies over nodes hand out themselves (not as terms): against differences of their gradients,
/// and what is left of them without the negative part.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/SparseCore>

#include "risorius/core/dense_algebra.h"
#include "risorius/solve/energy_term.h"

namespace risorius::testing_of {

/// `add(builder)` adds the second derivative.
Eigen::MatrixXd dense_second(long nodes, auto&& add) {
    solve::HessianBuilder builder(static_cast<int>(nodes), {});
    add(builder);
    const Eigen::MatrixXd lower = builder.build();
    return lower.selfadjointView<Eigen::Lower>();
}

/// Least and greatest u^T part u / u^T whole u and those between, ascending; `whole` is positive definite.
inline Eigen::VectorXd fractions(const Eigen::MatrixXd& part, const Eigen::MatrixXd& whole) {
    const SymmetricEigen modes = symmetric_eigen(whole);
    const Eigen::MatrixXd unit =
        modes.vectors * modes.values.cwiseSqrt().cwiseInverse().asDiagonal();
    return symmetric_eigenvalues(unit.transpose() * part * unit);
}

/// `add_energy(x, gradient)` returns E and adds dE/dx. Central differences of step `h`; `tolerance` is a share of the
/// stiffest entry.
void expect_slope_of_gradient(const Eigen::MatrixXd& second, const Points& x, auto&& add_energy,
                              double h, double tolerance) {
    const double stiffest = second.cwiseAbs().maxCoeff();
    ASSERT_GT(stiffest, 0);
    Points moved = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Points above = Points::Zero(x.rows(), 3), below = above;
        moved.data()[i] = x.data()[i] + h;
        add_energy(moved, above);
        moved.data()[i] = x.data()[i] - h;
        add_energy(moved, below);
        moved.data()[i] = x.data()[i];
        for (Eigen::Index j = 0; j < x.size(); ++j)
            ASSERT_NEAR(second(j, i), (above.data()[j] - below.data()[j]) / (2 * h),
                        tolerance * stiffest)
                << "coordinates " << j << ", " << i;
    }
}

/// Nowhere negative, and nowhere below the exact one.
inline void expect_positive_part(const Eigen::MatrixXd& positive, const Eigen::MatrixXd& exact) {
    const auto min = [](const Eigen::MatrixXd& m) { return symmetric_eigenvalues(m).minCoeff(); };
    const double rounding = 1e-11 * positive.cwiseAbs().maxCoeff();
    EXPECT_LT(min(exact), -rounding) << "nothing to take away: the check would say nothing";
    EXPECT_GT(min(positive), -rounding);
    EXPECT_GT(min(positive - exact), -rounding);
}

}  // namespace risorius::testing_of
