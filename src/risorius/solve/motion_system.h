// SPDX-License-Identifier: MIT
/// \file
/// Nodes with masses and the forces between them: what the integrators advance. It knows no faces.
///
///   m a = sum of the terms' forces       nodes that are fixed stand still or move as prescribed
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"

namespace risorius::solve {

struct MotionState {
    double t_s = 0;
    Points x;  ///< n x 3, m
    Points v;  ///< n x 3, m/s
};

/// Writes the rows of fixed nodes at time t: positions and velocities. Leaves the others alone.
using PrescribedMotion = std::function<void(double t_s, Points& x, Points& v)>;

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

    /// Puts fixed nodes where they belong at time t (as prescribed; otherwise v = 0).
    void place_fixed(double t_s, Points& x, Points& v) const;
    void begin_step(double t_s, double step_s, const Points& x, const Points& v) const;

    void force(double t_s, const Points& x, const Points& v, Points& force) const;  ///< N
    /// m/s^2, zero on fixed nodes.
    void acceleration(double t_s, const Points& x, const Points& v, Points& a) const;
    double energy(double t_s, const Points& x) const;  ///< stored, J
    double kinetic_energy(const Points& v) const;      ///< of free nodes, J

    /// Sum of the terms without inertia; the gradient is overwritten and zero on fixed nodes.
    double potential(const ImplicitStep& step, const Points& x, Points& gradient) const;
    /// Sum of the terms without inertia, added.
    void add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                     HessianBuilder& hessian) const;
    void add_metric(double step_s, MetricBuilder& metric) const;

  private:
    Eigen::VectorXd mass_kg_;
    Points inverse_mass_;  ///< of each coordinate, 1/kg; 0 on fixed nodes
    std::vector<char> fixed_;
    std::vector<int> fixed_nodes_;
    std::vector<std::shared_ptr<EnergyTerm>> terms_;
    PrescribedMotion prescribed_;
};

}  // namespace risorius::solve
