// What every force term owes: forces that are slopes of its energies, second derivatives that are slopes of those.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "solve/force_term.h"

namespace risorius::tissue {

inline Points noise(Eigen::Index rows, double amplitude, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> spread(-amplitude, amplitude);
    Points p(rows, 3);
    for (Eigen::Index i = 0; i < p.size(); ++i) p.data()[i] = spread(random);
    return p;
}

inline Points force_of(const solve::ForceTerm& term, const Points& x, const Points& v) {
    Points force = Points::Zero(x.rows(), 3);
    term.add_force(0, x, v, force);
    return force;
}

inline Points gradient_of(const solve::ForceTerm& term, const solve::ImplicitStep& step,
                          const Points& x) {
    Points gradient = Points::Zero(x.rows(), 3);
    term.add_potential(step, x, gradient);
    return gradient;
}

/// The whole symmetric matrix.
inline Eigen::MatrixXd hessian_of(const solve::ForceTerm& term, const solve::ImplicitStep& step,
                                  const Points& x, solve::Curvature curvature) {
    solve::HessianBuilder builder(static_cast<int>(x.rows()), {});
    term.add_hessian(step, x, curvature, builder);
    return Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>();
}

/// Central differences of a function of the positions in every coordinate.
template <class Function>
auto central_difference(const Function& function, const Points& x, Eigen::Index coordinate,
                        double step) {
    Points y = x;
    y.data()[coordinate] += step;
    const auto above = function(y);
    y.data()[coordinate] = x.data()[coordinate] - step;
    const auto below = function(y);
    return std::pair(above, below);
}

/// `tolerance` is relative to the largest force.
inline void expect_force_is_slope_of_energy(const solve::ForceTerm& term, const Points& x,
                                            double step, double tolerance) {
    const Points still = Points::Zero(x.rows(), 3);
    const Points force = force_of(term, x, still);
    const double largest = force.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto [above, below] =
            central_difference([&](const Points& y) { return term.energy(0, y); }, x, i, step);
        ASSERT_NEAR(-(above - below) / (2 * step), force.data()[i], tolerance * largest)
            << "coordinate " << i;
    }
}

inline void expect_gradient_is_slope_of_potential(const solve::ForceTerm& term,
                                                  const solve::ImplicitStep& implicit,
                                                  const Points& x, double step, double tolerance) {
    const Points gradient = gradient_of(term, implicit, x);
    const double largest = gradient.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    Points ignored = Points::Zero(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto [above, below] = central_difference(
            [&](const Points& y) { return term.add_potential(implicit, y, ignored); }, x, i, step);
        ASSERT_NEAR((above - below) / (2 * step), gradient.data()[i], tolerance * largest)
            << "coordinate " << i;
    }
}

inline void expect_hessian_is_slope_of_gradient(const solve::ForceTerm& term,
                                                const solve::ImplicitStep& implicit,
                                                const Points& x, double step, double tolerance) {
    const Eigen::MatrixXd hessian = hessian_of(term, implicit, x, solve::Curvature::kExact);
    const double largest = hessian.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto [above, below] = central_difference(
            [&](const Points& y) { return gradient_of(term, implicit, y); }, x, i, step);
        const Points slope = (above - below) / (2 * step);
        const Eigen::VectorXd column =
            Eigen::Map<const Eigen::VectorXd>(slope.data(), slope.size());
        ASSERT_LT((column - hessian.col(i)).cwiseAbs().maxCoeff(), tolerance * largest)
            << "coordinate " << i;
    }
}

/// Internal forces neither push nor turn the body as a whole; both relative to the largest force.
inline void expect_free_of_net_force_and_torque(const Points& x, const Points& force,
                                                double tolerance) {
    const double largest = force.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    double longest = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Vec3 p = x.row(i).transpose(), f = force.row(i).transpose();
        sum += f;
        torque += p.cross(f);
        longest = std::max(longest, p.norm());
    }
    EXPECT_LT(sum.norm(), tolerance * largest);
    EXPECT_LT(torque.norm(), tolerance * largest * longest);
}

}  // namespace risorius::tissue
