// One kind of force in a system of nodes. Explicit methods ask it for the force; implicit ones for the
// incremental potential whose minimum over x is the step:
//
//   Phi(x) = sum m |x - x_n - h v_n|^2 / (2 h^2) + sum over terms of [ E(x, t_n + h) + h R(x; x_n, h) ]
//
//   x, x_n  node positions at the end and the start of the step, n x 3, m     v = (x - x_n) / h
//   E       stored energy, J        R   dissipation of the term, W, with dR/dv = - damping force
//   h       step, s; infinite for an equilibrium, in which nothing moves and nothing is damped
#pragma once

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {

struct ImplicitStep {
    double end_s;         ///< t_n + h
    double step_s;        ///< h, may be infinite
    const Points& start;  ///< x_n

    double rate_hz() const { return 1.0 / step_s; }  ///< 0 for an equilibrium
};

enum class Curvature {
    kExact,    ///< the second derivative as it is, perhaps indefinite
    kPositive  ///< without its negative part, term by term: always a descent direction
};

/// One object serves one thread at a time: it may keep scratch arrays.
class ForceTerm {
  public:
    virtual ~ForceTerm() = default;

    /// Called once at the start of each step (explicit or implicit): search contacts, lag what the step freezes.
    virtual void begin_step(double /*t_s*/, double /*step_s*/, const Points& /*x*/,
                            const Points& /*v*/) {}

    /// Adds the force at time t on every node, damping included, n x 3, N.
    virtual void add_force(double t_s, const Points& x, const Points& v, Points& force) const = 0;

    /// Stored energy at time t, J, without dissipation. Dead loads store -f . x.
    virtual double energy(double t_s, const Points& x) const = 0;

    /// Returns E + h R and adds its derivative by x to `gradient`, n x 3, N.
    virtual double add_potential(const ImplicitStep& step, const Points& x,
                                 Points& gradient) const = 0;

    /// Adds the second derivative of what add_potential returns.
    virtual void add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                             HessianBuilder& hessian) const = 0;

    /// Adds a constant scalar matrix that bounds the second derivative near rest for steps of `step_s`: what a
    /// prefactored quasi-Newton method preconditions with.
    virtual void add_metric(double step_s, MetricBuilder& metric) const = 0;

    /// For Terzopoulos' semi-implicit step (Terzopoulos, Platt, Barr & Fleischer 1987): adds to `K` the scalar matrix
    /// of the term at x, so that its elastic force is - K(x) x, and to `damping` the scalar matrix of drag on single
    /// nodes. With `lag_rate` the strain rate of (x, v) is part of K. What cannot be written so is added to `force`
    /// as at x, v.
    virtual void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                            MetricBuilder& K, MetricBuilder& damping, Points& force) const {
        (void)lag_rate, (void)K, (void)damping;
        add_force(t_s, x, v, force);
    }
};

}  // namespace risorius::solve
