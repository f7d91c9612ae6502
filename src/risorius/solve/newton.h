// SPDX-License-Identifier: MIT
/// \file
/// Newton's method on the incremental potential of a system of nodes (energy_term.h): one implicit Euler step, or an
/// equilibrium when the step is infinite.
///
///   Phi(x) = sum m |x - y|^2 / (2 h^2) + sum over terms of (E + h R),   y = x_n + h v_n
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
    int iterations = 20;        ///< maximum number
    double tolerance_m = 1e-8;  ///< stop when Newton's move is at most this long on every node
    /// The second derivative that is tried first. kPositive is replaced by kExact where that is positive definite and
    /// convergence is slow. kExact is replaced by kPositive where it is indefinite.
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
    /// Number of multiplications of conjugate gradients, in matrix products and preconditioning. It is the same on every
    /// machine.
    double multiplications = 0;
    double potential_j = 0;  ///< Phi at the end
    double last_move_m = 0;  ///< length of the last full Newton move, maximum over the nodes
    bool converged = false;
    bool diverged = false;
};

/// Newton's method for one system. It keeps its buffers and the ordering of its factor between calls.
class Newton {
  public:
    /// Minimises Phi for a finite step, starting from x. The fixed nodes of x must have their positions at step.end_s. `target`
    /// is y, n x 3, m. Phi never increases, except by rounding. Where Newton's moves are far too long (large steps of a body
    /// that is soft in its rest shape), the method continues with the regularised steps of solve_equilibrium().
    NewtonReport minimise(const MotionSystem& system, const ImplicitStep& step,
                          const Points& target, const NewtonOptions& options, Points& x);

    /// Minimises the energy at step.end_s, starting from x. The step must be infinite. The mass of the nodes is added to each
    /// Newton step, as in an implicit step that starts without velocity. The length of this step is the pseudo-time step. It
    /// grows as long as the quadratic model is accurate, until the mass has no influence.
    NewtonReport solve_equilibrium(const MotionSystem& system, const ImplicitStep& step,
                                   const NewtonOptions& options, Points& x);

    /// Makes one Newton move from x with kExact, even if that is indefinite. If it is singular, kPositive is used, and this is
    /// counted as a halving. Returns false when neither gives a finite move.
    bool move_once(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                   LinearSolver linear, Points& x, NewtonReport& report);

  private:
    double evaluate(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                    const Points& x, Points& gradient, NewtonReport& report) const;
    /// direction_ = - (H + weight M)^-1 gradient_. H is the second derivative and M is the mass. Unless `any_sign`, the result
    /// must be a descent direction.
    bool solve(const MotionSystem& system, const ImplicitStep& step, const Points& x,
               double mass_weight, Curvature curvature, LinearSolver linear, double tolerance,
               bool any_sign, NewtonReport& report);
    HessianBuilder& hessian_of(const MotionSystem& system);
    /// Regularised Newton steps from x, where Phi is `e` and its gradient is gradient_. `added` is the first weight of the mass
    /// in addition to that of the step, 1/s^2.
    void regularised(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                     const NewtonOptions& options, double e, double added, Points& x,
                     NewtonReport& report);

    std::unique_ptr<HessianBuilder> hessian_;
    SymmetricFactor factor_;
    ConjugateGradients gradients_;
    Points gradient_, trial_gradient_, trial_, direction_, scratch_, began_;
};

/// Moves `state` to an equilibrium at its time; velocities become 0. It is the quasi-static method (kQuasiStatic) for a single
/// time.
IntegratorReport equilibrium(const MotionSystem& system, MotionState& state,
                             const IntegratorOptions& options);

}  // namespace risorius::solve
