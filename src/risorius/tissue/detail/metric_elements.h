// SPDX-License-Identifier: MIT
/// \file
/// Stretch and shear of curves and surfaces. In each element the tangents r_i are fixed differences of at most three nodes, as
/// the forward differences of a grid are, and the tangents of a triangle.
///
///   r_i = sum_k d_ik x_k      G_ij = r_i . r_j
///   E = 1/4 sum eta_ij (G_ij - G0_ij)^2        R = 1/4 sum phi_ij (dG_ij/dt)^2
///   force = - sum_i d_i sum_j (eta_ij (G_ij - G0_ij) + phi_ij dG_ij/dt) r_j
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/surface_material.h"

namespace risorius::tissue {

/// The list of elements, with their energy and forces.
class MetricElements {
  public:
    struct Element {
        int count = 0;
        int node[3] = {};
        double d[2][3] = {};              ///< d_ik; row 1 of a curve is zero
        Mat2 eta = Mat2::Zero();          ///< symmetric, per element
        Mat2 phi = Mat2::Zero();          ///< symmetric, per element
        Mat2 rest_metric = Mat2::Zero();  ///< G0
    };

    /// Adds an element. Its rest metric is computed from `rest`.
    void add(Element element, const Points& rest);

    const std::vector<Element>& list() const { return elements_; }

    double energy(const Points& x) const;
    void add_force(const Points& x, const Points& v, Points& force) const;
    double add_potential(const solve::ImplicitStep& step, const Points& x, Points& gradient) const;
    /// kPositive: only the positive part of the stress is used.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;
    void add_metric(double step_s, solve::MetricBuilder& metric) const;
    /// K contains the elastic stress. Damping is added to `force` unless its rate is lagged.
    void add_secant(const Points& x, const Points& v, bool lag_rate, solve::MetricBuilder& K,
                    Points& force) const;

  private:
    std::vector<Element> elements_;
};

}  // namespace risorius::tissue
