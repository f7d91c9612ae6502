// SPDX-License-Identifier: MIT
/// \file
/// Time integration of a system of nodes: eight explicit methods, three implicit ones and equilibrium, behind one interface.
///
///   h   length of a step, s     order   power of h to which the error of the motion is proportional
///
/// Sources: Press et al., Numerical Recipes; Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I; Cash & Karp
/// 1990, ACM TOMS 16(3); Bulirsch & Stoer with Gragg's modified midpoint rule; Terzopoulos, Platt, Barr & Fleischer 1987;
/// Baraff & Witkin 1998.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/solve/motion_system.h"

namespace risorius::solve {

/// The methods of integration.
enum class Method {
    kEuler,          ///< explicit Euler, order 1
    kVerlet,         ///< Stoermer's two-step form; for damping, velocities are backward differences
    kRungeKutta2,    ///< midpoint rule, order 2
    kRungeKutta4,    ///< classic, order 4
    kCashKarp,       ///< order 5; with a tolerance, the embedded order 4 controls the step
    kBulirschStoer,  ///< modified midpoint rule with extrapolation; controls its step
    kAdamsBashforth,  ///< order 4: uses 4 steps; started by Runge-Kutta 4
    kAdamsMoulton,    ///< predictor-corrector (PECE) of order 4
    kTerzopoulos,     ///< semi-implicit: stiffness at the start of the step, one linear solve
    kBaraffWitkin,    ///< implicit Euler with one linear solve
    kImplicitEuler,   ///< implicit Euler, solved by Newton's method with line search
    kQuasiStatic      ///< equilibrium at each requested time; velocities stay zero
};

/// "euler", "verlet", "rk2", "rk4", "rkck", "bulirsch-stoer", "adams-bashforth", "adams-moulton", "terzopoulos",
/// "baraff-witkin", "implicit-euler", "quasi-static".
const std::vector<std::string_view>& method_names();
Method method_named(std::string_view name);  ///< throws std::invalid_argument
std::string_view name_of(Method method);
bool is_explicit(Method method);

/// How the linear systems of implicit methods are solved.
enum class LinearSolver {
    kDirect,    ///< sparse factorisation in every Newton iteration
    kConjugate  ///< conjugate gradients, for large systems
};

/// Options of all methods. A method ignores those that are meant for other methods.
struct IntegratorOptions {
    Method method = Method::kImplicitEuler;
    double step_s = 1.0 / 60;  ///< first step if the method controls its step   (0, inf)
    /// Allowed error of one step of Cash-Karp and Bulirsch-Stoer, as a fraction of length_scale_m for positions and of
    /// length_scale_m / step for velocities. With 0, Cash-Karp has a fixed step and Bulirsch-Stoer uses 1e-6.
    double tolerance = 0;
    double length_scale_m = 1;  ///< size of the body; the unit of errors and of divergence
    double min_step_s = 1e-9;   ///< a controlled step that falls below this counts as divergence
    double diverged_at = 1e3;   ///< divergence: a node is this many length scales from its start
    /// Maximum number of Newton iterations per implicit step; an equilibrium may take ten times as many.
    int newton_iterations = 20;
    /// Stop when no node moves more than this fraction of the length scale.
    double newton_tolerance = 1e-8;
    /// Which second derivative implicit Euler uses; kBaraffWitkin tries kExact first.
    Curvature curvature = Curvature::kPositive;
    LinearSolver linear = LinearSolver::kDirect;
    /// Terzopoulos: the stiffness contains the viscous stress at the start of the step.
    bool lag_rate = false;
};

/// Cost and outcome of advance(). Divergence and missing convergence are results; no exception is thrown.
struct IntegratorReport {
    long steps = 0;
    long evaluations = 0;  ///< of forces, or of the potential with its gradient
    /// Number of steps that were repeated with a smaller size. For Newton's method: number of halvings of the line search and
    /// of rejected moves. For kBaraffWitkin: number of steps that were solved with kPositive because kExact was singular.
    long rejections = 0;
    long linear_solves = 0;  ///< factorisations or conjugate-gradient runs
    /// Maximum error of the accepted steps, as a fraction like `tolerance`. Implicit methods: length of the last Newton move,
    /// as a fraction of the length scale.
    double error_estimate = 0;
    bool diverged = false;
    double diverged_at_s = std::numeric_limits<double>::quiet_NaN();
    bool converged = true;  ///< every Newton solve met its tolerance

    /// Adds the report of a later advance().
    void add(const IntegratorReport& later);
};

/// Advances the state of a system in time by one method.
class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Forgets the history of multi-step methods and where the motion began. Call it after the state was changed by anything
    /// but advance(). A state whose time is not the end of the last advance() restarts the motion by itself.
    virtual void restart() = 0;

    /// Advances `state` to the time `until_s`. All steps have the length step_s, or the length that the method chooses; only
    /// the last one is shortened, so that it ends exactly at `until_s`. When the motion diverges, it stops and does not change
    /// the state further. Use one object for one system only: it keeps buffers from step to step.
    virtual IntegratorReport advance(const MotionSystem& system, MotionState& state,
                                     double until_s) = 0;
};

/// Throws std::invalid_argument for options outside their ranges.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options);

}  // namespace risorius::solve
