// SPDX-License-Identifier: MIT
/// \file
/// Newton's method on the incremental potential of a system of nodes (energy_term.h): one implicit Euler step, or an
/// equilibrium when the step is infinite.
///
///   Phi(x) = sum m |x - y|^2 / (2 h^2) + terms(x),   y = x_n + h v_n       g = dPhi/dx       d   Newton's move
///
/// Source: Nocedal & Wright, Numerical Optimization, ch. 3 (line search), 10 and 11 (regularised steps).
#pragma once

#include "risorius/solve/detail/conjugate_gradients.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/motion_system.h"
#include "risorius/solve/symmetric_factor.h"

namespace risorius::solve {

/// Limits and choices of a solve.
struct NewtonOptions {
    int iterations = 20;        ///< maximum
    double tolerance_m = 1e-8;  ///< stop when Newton's move is at most this long on every node
    /// The first choice. kPositive is replaced by the exact curvature where that is positive definite and convergence is slow.
    /// kExact is replaced by the positive one where the exact one is indefinite.
    Curvature curvature = Curvature::kPositive;
    LinearSolver linear = LinearSolver::kDirect;
    double first_step_s = 1.0 / 60;  ///< equilibria: first step of pseudo-time
    double farthest_m = 1e3;         ///< equilibria: a node that has moved farther has diverged
};

/// Cost and outcome of a solve.
struct NewtonReport {
    int iterations = 0;
    long evaluations = 0;
    long halvings = 0;  ///< of the line search; equilibria: rejected moves
    long linear_solves = 0;
    /// Work of conjugate gradients: multiplications in matrix products and preconditioning. The number is the same on every
    /// machine.
    double multiplications = 0;
    double potential_j = 0;  ///< Phi at the end
    double last_move_m = 0;  ///< maximum over the nodes of the last full Newton move
    bool converged = false;
    bool diverged = false;
};

/// Keeps its buffers and the ordering of its factor between calls. An object serves one system.
class Newton {
  public:
    /// Minimises Phi for a finite step, starting from x. Fixed nodes must be at their places for step.end_s. `target` is y. Phi
    /// never rises, except by rounding. Where Newton's moves are far too long (large steps of a body that is soft in its rest
    /// shape), the method goes on as in solve_equilibrium().
    NewtonReport minimise(const MotionSystem& system, const ImplicitStep& step,
                          const Points& target, const NewtonOptions& options, Points& x);

    /// Minimises the energy at step.end_s, starting from x. The step must be infinite. Newton steps are regularised by mass,
    /// like implicit steps that start without velocity. This pseudo-time step grows while the quadratic model holds, until it
    /// no longer matters.
    NewtonReport solve_equilibrium(const MotionSystem& system, const ImplicitStep& step,
                                   const NewtonOptions& options, Points& x);

    /// One Newton move from x with the exact curvature, even if indefinite. If that is singular, the positive one is used and
    /// counted as a halving. Returns false when neither gives a finite move.
    bool move_once(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                   LinearSolver linear, Points& x, NewtonReport& report);

  private:
    double evaluate(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                    const Points& x, Points& gradient, NewtonReport& report) const;
    /// direction_ = - (H + weight M)^-1 gradient_. It must be a descent direction unless `any_sign`.
    bool solve(const MotionSystem& system, const ImplicitStep& step, const Points& x,
               double mass_weight, Curvature curvature, LinearSolver linear, double tolerance,
               bool any_sign, NewtonReport& report);
    HessianBuilder& hessian_of(const MotionSystem& system);
    /// Starts from x, where Phi is `e` and its gradient is gradient_. `added` is the first mass weight in addition to that of
    /// the step, 1/s^2.
    void regularised(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                     const NewtonOptions& options, double e, double added, Points& x,
                     NewtonReport& report);

    std::unique_ptr<HessianBuilder> hessian_;
    SymmetricFactor factor_;
    ConjugateGradients gradients_;
    Points gradient_, trial_gradient_, trial_, direction_, scratch_, began_;
};

/// Moves `state` to an equilibrium at its time; velocities become 0. This is the one-shot form of the quasi-static method.
IntegratorReport equilibrium(const MotionSystem& system, MotionState& state,
                             const IntegratorOptions& options);

}  // namespace risorius::solve
