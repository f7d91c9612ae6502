// SPDX-License-Identifier: MIT
/// \file
/// Newton's method on the incremental potential of a system of nodes (energy_term.h): one implicit Euler step, or an
/// equilibrium when the step is infinite.
///
///   Phi(x) = sum m |x - y|^2 / (2 h^2) + terms(x),   y = x_n + h v_n       g = dPhi/dx       d   Newton's move
///
/// Nocedal & Wright, Numerical Optimization, ch. 3 (line search), 10 and 11 (regularised steps).
#pragma once

#include "risorius/solve/detail/conjugate_gradients.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/motion_system.h"
#include "risorius/solve/symmetric_factor.h"

namespace risorius::solve {

struct NewtonOptions {
    int iterations = 20;        ///< at most
    double tolerance_m = 1e-8;  ///< stop when Newton's move is no longer than this on any node
    /// To begin with. A positive curvature gives way to the exact one where that is positive definite and convergence is
    /// slow; an exact one that is indefinite gives way to the positive one.
    Curvature curvature = Curvature::kPositive;
    LinearSolver linear = LinearSolver::kDirect;
    double first_step_s = 1.0 / 60;  ///< equilibria: pseudo-time to begin with
    double farthest_m = 1e3;         ///< equilibria: a node moved farther than this is divergence
};

struct NewtonReport {
    int iterations = 0;
    long evaluations = 0;
    long halvings = 0;  ///< of the line search; equilibria: moves refused
    long linear_solves = 0;
    /// Of conjugate gradients: matrix products and preconditioning, the bulk of the work; the same on any machine.
    double multiplications = 0;
    double potential_j = 0;  ///< Phi where it stopped
    double last_move_m = 0;  ///< of the node that moved most, by the whole of Newton's last move
    bool converged = false;
    bool diverged = false;
};

/// Keeps its buffers and the ordering of its factor between calls. Serves one system.
class Newton {
  public:
    /// Minimises Phi for a finite step from x, whose fixed nodes must be in place at step.end_s. `target` is y. Phi never
    /// rises but by rounding. Where Newton's moves are far too long (large steps of what is soft at rest) it goes on as
    /// solve_equilibrium() does.
    NewtonReport minimise(const MotionSystem& system, const ImplicitStep& step,
                          const Points& target, const NewtonOptions& options, Points& x);

    /// Minimises the energy at step.end_s (the step must be infinite) from x. Newton steps are regularised by mass, as
    /// implicit steps from rest are; that pseudo-time step grows while the quadratic model holds, until it no longer matters.
    NewtonReport solve_equilibrium(const MotionSystem& system, const ImplicitStep& step,
                                   const NewtonOptions& options, Points& x);

    /// One Newton move from x with the exact curvature as it is, indefinite or not; where that is singular, with the
    /// positive one (a halving is counted). False when neither gives a finite move.
    bool move_once(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                   LinearSolver linear, Points& x, NewtonReport& report);

  private:
    double evaluate(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                    const Points& x, Points& gradient, NewtonReport& report) const;
    /// direction_ = - (H + weight M)^-1 gradient_, which must be a descent direction unless `any_sign`.
    bool solve(const MotionSystem& system, const ImplicitStep& step, const Points& x,
               double mass_weight, Curvature curvature, LinearSolver linear, double tolerance,
               bool any_sign, NewtonReport& report);
    HessianBuilder& hessian_of(const MotionSystem& system);
    /// From x, where Phi is `e` and its gradient gradient_. `added` is the first mass weight beyond that of the step, 1/s^2.
    void regularised(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                     const NewtonOptions& options, double e, double added, Points& x,
                     NewtonReport& report);

    std::unique_ptr<HessianBuilder> hessian_;
    SymmetricFactor factor_;
    ConjugateGradients gradients_;
    Points gradient_, trial_gradient_, trial_, direction_, scratch_, began_;
};

/// Moves state to an equilibrium at its time, velocities 0. One-shot form of the quasi-static method.
IntegratorReport equilibrium(const MotionSystem& system, MotionState& state,
                             const IntegratorOptions& options);

}  // namespace risorius::solve
