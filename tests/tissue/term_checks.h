// SPDX-License-Identifier: MIT
/// \file
/// Checks that every force term of a surface or curve must pass: forces and second derivatives against differences, laws of
/// motion, and a linear solve for small deflections.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <limits>
#include <vector>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/solve/energy_term.h"
#include "tissue/layered_block.h"

namespace risorius::tissue::laws {

using testing_of::force_of;
using testing_of::potential_gradient;

inline solve::ImplicitStep no_motion(const Points& x) {
    return {0.0, std::numeric_limits<double>::infinity(), x};
}

inline Points force_of(const solve::EnergyTerm& term, const Points& x) {
    return force_of(term, x, Points::Zero(x.rows(), 3));
}

inline Eigen::MatrixXd dense_hessian(const solve::EnergyTerm& term, const solve::ImplicitStep& step,
                                     const Points& x, solve::Curvature curvature) {
    solve::HessianBuilder builder(static_cast<int>(x.rows()), {});
    term.add_hessian(step, x, curvature, builder);
    const Eigen::MatrixXd lower = builder.build();
    return lower.selfadjointView<Eigen::Lower>();
}

inline Eigen::MatrixXd dense(const solve::MetricBuilder& builder) {
    const Eigen::MatrixXd lower = builder.build({});
    return lower.selfadjointView<Eigen::Lower>();
}

/// Force = - dE/dx, by central differences with a step that suits bodies of about 1 m.
inline void expect_force_is_exact(const solve::EnergyTerm& term, const Points& x,
                                  double tolerance = 1e-8) {
    const Points force = force_of(term, x);
    const double largest = force.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    const double h = 1e-6;
    Points y = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        y.data()[i] = x.data()[i] + h;
        const double above = term.energy(0, y);
        y.data()[i] = x.data()[i] - h;
        const double below = term.energy(0, y);
        y.data()[i] = x.data()[i];
        ASSERT_NEAR(-(above - below) / (2 * h), force.data()[i], tolerance * largest)
            << "coordinate " << i;
    }
}

/// Compares the gradient of the potential with differences of its values, and the second derivative with differences of
/// gradients. Both include damping.
inline void expect_potential_is_exact(const solve::EnergyTerm& term, const Points& start,
                                      const Points& x, double step_s) {
    const solve::ImplicitStep step{step_s, step_s, start};
    const Points gradient = potential_gradient(term, step, x);
    const Eigen::MatrixXd hessian = dense_hessian(term, step, x, solve::Curvature::kExact);
    const double h = 1e-6;
    const double largest = gradient.cwiseAbs().maxCoeff();
    const double stiffest = hessian.cwiseAbs().maxCoeff();
    Points y = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Points above = Points::Zero(x.rows(), 3), below = above;
        y.data()[i] = x.data()[i] + h;
        const double energy_above = term.add_potential(step, y, above);
        y.data()[i] = x.data()[i] - h;
        const double energy_below = term.add_potential(step, y, below);
        y.data()[i] = x.data()[i];
        ASSERT_NEAR((energy_above - energy_below) / (2 * h), gradient.data()[i], 1e-7 * largest)
            << "coordinate " << i;
        const Points slope = (above - below) / (2 * h);
        for (Eigen::Index j = 0; j < x.size(); ++j)
            ASSERT_NEAR(slope.data()[j], hessian(j, i), 1e-7 * stiffest) << j << ", " << i;
    }
}

inline void expect_positive_curvature(const solve::EnergyTerm& term, const Points& start,
                                      const Points& x, double step_s) {
    const solve::ImplicitStep step{step_s, step_s, start};
    const Eigen::MatrixXd hessian = dense_hessian(term, step, x, solve::Curvature::kPositive);
    const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(hessian);
    EXPECT_GT(eigenvalues.maxCoeff(), 0.0);
    EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff());
}

/// The scalar metric is above the second derivative at the rest shape in every direction, but not by far.
inline void expect_metric_bounds_rest(const solve::EnergyTerm& term, const Points& rest,
                                      double step_s, double at_most) {
    const solve::ImplicitStep step{step_s, step_s, rest};
    const Eigen::MatrixXd hessian = dense_hessian(term, step, rest, solve::Curvature::kExact);
    solve::MetricBuilder builder(static_cast<int>(rest.rows()));
    term.add_metric(step_s, builder);
    const Eigen::MatrixXd scalar = dense(builder);
    Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(hessian.rows(), hessian.cols());
    for (Eigen::Index i = 0; i < scalar.rows(); ++i)
        for (Eigen::Index j = 0; j < scalar.cols(); ++j)
            for (int k = 0; k < 3; ++k) metric(3 * i + k, 3 * j + k) = scalar(i, j);
    const auto eigenvalues = [](const Eigen::MatrixXd& m) -> Eigen::VectorXd {
        return symmetric_eigenvalues(m);
    };
    const double stiffest = eigenvalues(hessian).maxCoeff();
    EXPECT_GT(eigenvalues(metric - hessian).minCoeff(), -1e-9 * stiffest);
    EXPECT_LT(eigenvalues(metric).maxCoeff(), at_most * stiffest);
}

inline void expect_rest_is_free(const solve::EnergyTerm& term, const Points& rest) {
    // Relative to the force of a shape that is 1 % away.
    const double size = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff();
    const double scale = force_of(term, shaken(rest, 0.01 * size, 11)).cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 0.0);
    EXPECT_LT(force_of(term, rest).cwiseAbs().maxCoeff(), 1e-10 * scale);
    const Points turned = moved(rest, some_motion());
    EXPECT_LT(force_of(term, turned).cwiseAbs().maxCoeff(), 1e-10 * scale);
    EXPECT_NEAR(term.energy(0, rest), 0, 1e-20 * scale * size);
}

/// Damping removes energy, but none from a body that rotates as a whole.
inline void expect_damping_dissipates(const solve::EnergyTerm& term, const Points& x) {
    const Points v = shaken(Points::Zero(x.rows(), 3), 1.0, 12);
    const Points damping = force_of(term, x, v) - force_of(term, x);
    EXPECT_LT(damping.cwiseProduct(v).sum(), 0.0);
    expect_no_net_force_or_torque(x, damping);
    Points turning(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        turning.row(i) = Vec3(0.3, -1, 0.7).cross(Vec3(x.row(i).transpose())).transpose();
    const Points none = force_of(term, x, turning) - force_of(term, x);
    EXPECT_LT(none.cwiseAbs().maxCoeff(), 1e-12 * damping.cwiseAbs().maxCoeff());
}

/// - K x + the explicit force is the force, with and without a lagged rate.
inline void expect_secant_is_the_force(const solve::EnergyTerm& term, const Points& x) {
    const Points v = shaken(Points::Zero(x.rows(), 3), 1.0, 13);
    const Points force = force_of(term, x, v);
    for (const bool lag_rate : {false, true}) {
        solve::MetricBuilder K(static_cast<int>(x.rows())), damping(static_cast<int>(x.rows()));
        Points rest_of_it = Points::Zero(x.rows(), 3);
        term.add_secant(0, x, v, lag_rate, K, damping, rest_of_it);
        const Points secant = rest_of_it - dense(K) * x;
        EXPECT_LT((secant - force).cwiseAbs().maxCoeff(), 1e-11 * force.cwiseAbs().maxCoeff());
    }
}

/// Displacement of the linearised body under a constant load.
inline Points small_deflection(const solve::EnergyTerm& term, const Points& rest,
                               const std::vector<char>& fixed, const Points& load) {
    solve::HessianBuilder builder(static_cast<int>(rest.rows()), fixed);
    term.add_hessian(no_motion(rest), rest, solve::Curvature::kExact, builder);
    Eigen::VectorXd b(load.size());
    for (Eigen::Index i = 0; i < load.size(); ++i)
        b[i] = fixed[static_cast<std::size_t>(i / 3)] ? 0 : load.data()[i];
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(builder.build());
    EXPECT_EQ(solver.info(), Eigen::Success);
    const Eigen::VectorXd u = solver.solve(b);
    Points out(rest.rows(), 3);
    for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] = u[i];
    return out;
}

/// Equilibrium under a constant load by Newton's method with halving. `x` is the start and the result. Returns true when no
/// node moved more than 1e-9 m in the last step.
inline bool solve(const solve::EnergyTerm& term, const std::vector<char>& fixed, const Points& load,
                  Points& x, int iterations = 200) {
    const auto total = [&](const Points& y, Points& gradient) {
        gradient = -load;
        const double stored = term.add_potential(no_motion(y), y, gradient);
        return stored - load.cwiseProduct(y).sum();
    };
    solve::HessianBuilder builder(static_cast<int>(x.rows()), fixed);
    Points gradient, ignored;
    double energy = total(x, gradient);
    for (int iteration = 0; iteration < iterations; ++iteration) {
        builder.clear();
        term.add_hessian(no_motion(x), x, solve::Curvature::kPositive, builder);
        for (int i = 0; i < x.rows(); ++i) builder.add_diagonal(i, 1e-7);
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(builder.build());
        Eigen::VectorXd slope(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i)
            slope[i] = fixed[static_cast<std::size_t>(i / 3)] ? 0 : gradient.data()[i];
        const Eigen::VectorXd step = -solver.solve(slope);
        double fraction = 1, next = 0;
        Points y = x;
        for (int halving = 0; halving < 40; ++halving, fraction *= 0.5) {
            for (Eigen::Index i = 0; i < x.size(); ++i)
                y.data()[i] = x.data()[i] + fraction * step[i];
            next = total(y, ignored);
            if (next <= energy + 1e-4 * fraction * step.dot(slope)) break;
        }
        const double moved = fraction * step.cwiseAbs().maxCoeff();
        x = y;
        energy = total(x, gradient);
        if (moved < 1e-9) return true;
    }
    return false;
}

}  // namespace risorius::tissue::laws
