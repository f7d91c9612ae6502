// SPDX-License-Identifier: MIT
/// \file
/// Drag on the nodes of any body: f = -c v, with the coefficient c of each node, N s/m, and its velocity v, m/s. It is the
/// damping in the equation of motion of the thesis, eq. (11).
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005 ("the thesis"), section 3.2.
#pragma once

#include "risorius/solve/energy_term.h"

namespace risorius::tissue {

/// The drag force of all nodes.
class Drag : public solve::EnergyTerm {
  public:
    /// c of each node, N s/m   [0, inf)
    explicit Drag(Eigen::VectorXd drag_ns_per_m);

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double, const Points&) const override { return 0; }
    /// Returns h R = sum c |x - x_n|^2 / (2 h), J, for a step of length h from x_n, and adds its derivative to `gradient`.
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// Adds c of each node to the diagonal of `damping`. Nothing is added to `K` and `force`.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

  private:
    Eigen::VectorXd drag_;
};

}  // namespace risorius::tissue
