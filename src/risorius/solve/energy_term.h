// SPDX-License-Identifier: MIT
/// \file
/// An energy term: one energy of a system of nodes, and the force that follows from it. All forces of the library are energy
/// terms.
///
/// An explicit integrator asks a term for its force. An implicit integrator minimises the incremental potential over x:
///
///     Phi(x) = sum m |x - x_n - h v_n|^2 / (2 h^2) + sum over terms of [ E(x, t_n + h) + h R(x; x_n, h) ]
///
/// - x, x_n: node positions at the end and the start of the step, n x 3, m; v = (x - x_n) / h; v_n: velocities at the start
/// - m: mass of a node, kg; t_n: time at the start of the step, s
/// - E: stored energy, J
/// - R: dissipation of the term, W, with dR/dv = - damping force
/// - h: length of the step, s. It is infinite for an equilibrium: there is no inertia and no damping.
///
/// **How to add a force.** Derive a class from EnergyTerm in a file of its own. Three operations are required: add_potential
/// (energy and gradient), add_hessian and add_metric. Override begin_step() when the term depends on where a step starts, and
/// add_force() and energy() when it damps or depends on time. Then add it:
/// - to a soft body or another MotionSystem: call `system.add(std::make_shared<MyForce>(...))`;
/// - to the face: write one line in FaceTissue::build_terms() (face/solver/detail/face_tissue.cpp), or call Face::add_force().
///   A force that takes part in the motion of bone, lids or air derives from face::FaceTerm (face/solver/detail/face_terms.h).
///
/// Check the derivatives of the new class with tests/force_term_checks.h.
#pragma once

#include <limits>

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {

/// The step that an implicit integrator solves, or an equilibrium when step_s is infinite.
struct ImplicitStep {
    double end_s;         ///< t_n + h, s
    double step_s;        ///< h, s; may be infinite
    const Points& start;  ///< x_n, n x 3, m

    double rate_hz() const { return 1.0 / step_s; }  ///< 0 for an equilibrium
};

/// Which second derivative add_hessian() adds.
enum class Curvature {
    kExact,  ///< the second derivative, which may be indefinite
    /// The second derivative without the negative part of each element. A Newton step with it is always a descent direction.
    kPositive
};

/// One energy of a system and its derivatives. A term may keep scratch arrays, so only one thread at a time may use an object.
class EnergyTerm {
  public:
    virtual ~EnergyTerm() = default;

    /// The integrator calls this once at the start of each step, explicit or implicit. A term searches its contacts here and
    /// stores everything that stays fixed during the step. `v` may be empty when the caller has no velocities.
    virtual void begin_step(double /*t_s*/, double /*step_s*/, const Points& /*x*/,
                            const Points& /*v*/) {}

    /// Adds the force on every node at time t, with damping, to `force`, n x 3, N. The default is the negative gradient of the
    /// stored energy; it is correct for terms without damping.
    virtual void add_force(double t_s, const Points& x, const Points& /*v*/, Points& force) const {
        Points gradient = Points::Zero(x.rows(), 3);
        add_potential({t_s, std::numeric_limits<double>::infinity(), x}, x, gradient);
        force -= gradient;
    }

    /// Returns the stored energy E at time t, J, without dissipation. A constant force f stores -f . x.
    virtual double energy(double t_s, const Points& x) const {
        Points unused = Points::Zero(x.rows(), 3);
        return add_potential({t_s, std::numeric_limits<double>::infinity(), x}, x, unused);
    }

    /// Returns E + h R, J, and adds its derivative by x to `gradient`, n x 3, N.
    virtual double add_potential(const ImplicitStep& step, const Points& x,
                                 Points& gradient) const = 0;

    /// Adds the second derivative of the value of add_potential(), N/m.
    virtual void add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                             HessianBuilder& hessian) const = 0;

    /// Adds a constant matrix, N/m, that bounds the second derivative near the rest shape for steps of `step_s`. It is an n x n
    /// matrix with one number per pair of nodes, used for x, y and z alike. Quasi-Newton methods factor the sum of these
    /// matrices once and use it as their preconditioner.
    virtual void add_metric(double step_s, MetricBuilder& metric) const = 0;

    /// For Terzopoulos' semi-implicit step (Terzopoulos, Platt, Barr & Fleischer 1987). K, N/m, and damping, N s/m, are n x n
    /// matrices with one number per pair of nodes, used for x, y and z alike. Adds the stiffness of the term at x to `K`, so
    /// that its elastic force is - K(x) x, and the drag on single nodes to `damping`. With `lag_rate`, K contains the viscous
    /// stress too, from the strain rate of (x, v): the rate is lagged. All other forces of the term at x, v are added to
    /// `force`. A term without such matrices adds its whole force to `force`.
    virtual void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                            MetricBuilder& K, MetricBuilder& damping, Points& force) const {
        (void)lag_rate, (void)K, (void)damping;
        add_force(t_s, x, v, force);
    }
};

}  // namespace risorius::solve
