// SPDX-License-Identifier: MIT
/// \file
/// Adds the energy term of one body to a system of several bodies. The term works only on the rows of its own body, numbered
/// from 0.
#pragma once

#include <memory>

#include "risorius/solve/energy_term.h"

namespace risorius::solve {

/// Passes the rows of one body of a system to a term of that body.
class PartTerm : public EnergyTerm {
  public:
    /// Rows [first, first + count) of the system belong to the term.
    PartTerm(std::shared_ptr<EnergyTerm> term, int first, int count);

    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                     HessianBuilder& hessian) const override;
    void add_metric(double step_s, MetricBuilder& metric) const override;
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate, MetricBuilder& K,
                    MetricBuilder& damping, Points& force) const override;

  private:
    void copy_to(MetricBuilder& part, MetricBuilder& whole) const;

    std::shared_ptr<EnergyTerm> term_;
    int first_, count_;
    mutable Points x_, v_, start_, out_;  // the part's rows
    mutable HessianBuilder hessian_;
};

}  // namespace risorius::solve
