// SPDX-License-Identifier: MIT
/// \file
/// Nodes with masses and the forces between them, as the integrators advance them. Nothing here is specific to faces.
///
///   m a = sum of the forces of all terms       fixed nodes are at rest or have a prescribed motion
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"

namespace risorius::solve {

/// The state of all nodes at one time.
struct MotionState {
    double t_s = 0;
    Points x;  ///< n x 3, m
    Points v;  ///< n x 3, m/s
};

/// Writes the positions and velocities of fixed nodes at time t. Must leave all other rows unchanged.
using PrescribedMotion = std::function<void(double t_s, Points& x, Points& v)>;

/// The masses, the fixed nodes and the energy terms of a system.
class MotionSystem {
  public:
    /// Throws std::invalid_argument unless every free node has a positive, finite mass.
    MotionSystem(Eigen::VectorXd mass_kg, std::vector<char> fixed);

    void add(std::shared_ptr<EnergyTerm> term);
    void set_boundary_conditions(PrescribedMotion motion) { prescribed_ = std::move(motion); }

    int size() const { return static_cast<int>(mass_kg_.size()); }
    const Eigen::VectorXd& mass_kg() const { return mass_kg_; }
    const std::vector<char>& fixed() const { return fixed_; }  ///< one flag per node
    const std::vector<std::shared_ptr<EnergyTerm>>& terms() const { return terms_; }

    /// Sets the positions and velocities of the fixed nodes to those at time t. Without a prescribed motion, only sets v = 0.
    void place_fixed(double t_s, Points& x, Points& v) const;
    /// Calls begin_step() of all terms.
    void begin_step(double t_s, double step_s, const Points& x, const Points& v) const;

    void force(double t_s, const Points& x, const Points& v,
               Points& force) const;  ///< N; overwritten
    /// Writes the acceleration of every node, m/s^2, to `a`; it is zero on fixed nodes.
    void acceleration(double t_s, const Points& x, const Points& v, Points& a) const;
    double energy(double t_s, const Points& x) const;  ///< stored energy, J
    double kinetic_energy(const Points& v) const;      ///< of free nodes, J

    /// Returns the sum of E + h R over the terms, J, without inertia. `gradient`, n x 3, N, is overwritten; it is zero on fixed
    /// nodes.
    double potential(const ImplicitStep& step, const Points& x, Points& gradient) const;
    /// Adds the second derivatives of all terms, without inertia.
    void add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                     HessianBuilder& hessian) const;
    /// Adds the metrics of all terms, without inertia.
    void add_metric(double step_s, MetricBuilder& metric) const;

  private:
    Eigen::VectorXd mass_kg_;
    Points inverse_mass_;  ///< n x 3, of each coordinate, 1/kg; 0 on fixed nodes
    std::vector<char> fixed_;
    std::vector<int> fixed_nodes_;
    std::vector<std::shared_ptr<EnergyTerm>> terms_;
    PrescribedMotion prescribed_;
};

}  // namespace risorius::solve
