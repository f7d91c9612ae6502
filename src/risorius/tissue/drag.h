// SPDX-License-Identifier: MIT
/// \file
/// Constant damping of single nodes: the c of the equation of motion (11), f = -c v, for any body.
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, section 3.2.
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
    /// h R = sum c |x - x_n|^2 / (2 h)
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// The whole matrix is added to `damping`.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

  private:
    Eigen::VectorXd drag_;
};

}  // namespace risorius::tissue
