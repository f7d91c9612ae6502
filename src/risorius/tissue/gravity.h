// SPDX-License-Identifier: MIT
/// \file
/// Weight of the nodes of any body: f = m g.
#pragma once

#include "risorius/solve/energy_term.h"

namespace risorius::tissue {

constexpr double kStandardGravity = 9.81;  ///< m/s^2

/// The weight of all nodes.
class Gravity : public solve::EnergyTerm {
  public:
    /// One mass per node, kg, fixed nodes included.
    explicit Gravity(Eigen::VectorXd mass_kg,
                     const Vec3& gravity_m_per_s2 = Vec3(0, 0, -kStandardGravity));

    const Vec3& gravity() const { return gravity_; }
    void set_gravity(const Vec3& gravity_m_per_s2) { gravity_ = gravity_m_per_s2; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;  ///< J; zero at the origin
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}

  private:
    Eigen::VectorXd mass_kg_;
    Vec3 gravity_;
};

}  // namespace risorius::tissue
