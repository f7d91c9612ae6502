// SPDX-License-Identifier: MIT
/// \file
/// What every energy term must keep: its gradient, force and second derivative belong to its energy.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <random>

#include "risorius/core/dense_algebra.h"
#include "risorius/solve/energy_term.h"

namespace risorius::testing_of {

/// Deterministic values in [-amount, amount].
inline Points random_points(long rows, double amount, unsigned seed) {
    std::mt19937 generator(seed);
    Points out(rows, 3);
    for (long i = 0; i < rows; ++i)
        for (int k = 0; k < 3; ++k)
            out(i, k) = amount * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
    return out;
}

inline Points force_of(const solve::EnergyTerm& term, const Points& x, const Points& v) {
    Points force = Points::Zero(x.rows(), 3);
    term.add_force(0, x, v, force);
    return force;
}

inline Points potential_gradient(const solve::EnergyTerm& term, const solve::ImplicitStep& step,
                                 const Points& x) {
    Points gradient = Points::Zero(x.rows(), 3);
    term.add_potential(step, x, gradient);
    return gradient;
}

inline Eigen::MatrixXd hessian(const solve::EnergyTerm& term, const solve::ImplicitStep& step,
                               const Points& x, solve::Curvature curvature) {
    solve::HessianBuilder builder(static_cast<int>(x.rows()), {});
    term.add_hessian(step, x, curvature, builder);
    const Eigen::MatrixXd lower = builder.build();
    return Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>());
}

/// The gradient of add_potential against central differences; `tolerance` is a share of the largest entry.
inline void expect_gradient_of_potential(const solve::EnergyTerm& term,
                                         const solve::ImplicitStep& step, const Points& x,
                                         double difference_m, double tolerance) {
    const Points gradient = potential_gradient(term, step, x);
    const double scale = gradient.cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 0) << "nothing acts: the check would say nothing";
    Points moved = x, unused = x;
    for (long i = 0; i < x.rows(); ++i)
        for (int k = 0; k < 3; ++k) {
            moved(i, k) = x(i, k) + difference_m;
            const double above = term.add_potential(step, moved, unused);
            moved(i, k) = x(i, k) - difference_m;
            const double below = term.add_potential(step, moved, unused);
            moved(i, k) = x(i, k);
            EXPECT_NEAR(gradient(i, k), (above - below) / (2 * difference_m), tolerance * scale)
                << "node " << i << ", coordinate " << k;
        }
}

/// With no velocity the force is minus the slope of the stored energy.
inline void expect_force_is_minus_slope_of_energy(const solve::EnergyTerm& term, double t_s,
                                                  const Points& x, double difference_m,
                                                  double tolerance) {
    Points force = Points::Zero(x.rows(), 3);
    term.add_force(t_s, x, Points::Zero(x.rows(), 3), force);
    const double scale = force.cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 0) << "nothing acts: the check would say nothing";
    Points moved = x;
    for (long i = 0; i < x.rows(); ++i)
        for (int k = 0; k < 3; ++k) {
            moved(i, k) = x(i, k) + difference_m;
            const double above = term.energy(t_s, moved);
            moved(i, k) = x(i, k) - difference_m;
            const double below = term.energy(t_s, moved);
            moved(i, k) = x(i, k);
            EXPECT_NEAR(force(i, k), -(above - below) / (2 * difference_m), tolerance * scale)
                << "node " << i << ", coordinate " << k;
        }
}

/// The exact second derivative against central differences of the gradient.
inline void expect_hessian_of_potential(const solve::EnergyTerm& term,
                                        const solve::ImplicitStep& step, const Points& x,
                                        double difference_m, double tolerance) {
    const Eigen::MatrixXd H = hessian(term, step, x, solve::Curvature::kExact);
    const double scale = H.cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 0) << "nothing acts: the check would say nothing";
    Points moved = x;
    for (long i = 0; i < x.rows(); ++i)
        for (int k = 0; k < 3; ++k) {
            moved(i, k) = x(i, k) + difference_m;
            const Points above = potential_gradient(term, step, moved);
            moved(i, k) = x(i, k) - difference_m;
            const Points below = potential_gradient(term, step, moved);
            moved(i, k) = x(i, k);
            const Points slope = (above - below) / (2 * difference_m);
            for (long j = 0; j < x.rows(); ++j)
                for (int l = 0; l < 3; ++l)
                    EXPECT_NEAR(H(3 * j + l, 3 * i + k), slope(j, l), tolerance * scale)
                        << "nodes " << j << ", " << i << ", coordinates " << l << ", " << k;
        }
}

/// The projected second derivative has no negative part, and is the exact one where that has none.
inline void expect_projection(const solve::EnergyTerm& term, const solve::ImplicitStep& step,
                              const Points& x) {
    ASSERT_EQ(step.start.rows(), x.rows()) << "a step of other points";
    const Eigen::MatrixXd positive = hessian(term, step, x, solve::Curvature::kPositive);
    const Eigen::VectorXd values = symmetric_eigenvalues(positive);
    EXPECT_GE(values.minCoeff(), -1e-9 * values.cwiseAbs().maxCoeff());
}

}  // namespace risorius::testing_of
