// SPDX-License-Identifier: MIT
/// \file
/// Time integration of a system of nodes: eight explicit methods, three implicit ones and equilibrium, behind one interface.
///
///   y = (x, v)      h   step, s
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
    kEuler,          ///< explicit, order 1
    kVerlet,         ///< Stoermer's two-step form; damping uses the velocity by backward difference
    kRungeKutta2,    ///< midpoint
    kRungeKutta4,    ///< classic
    kCashKarp,       ///< order 5; with a tolerance, the embedded order 4 controls the step
    kBulirschStoer,  ///< modified midpoint rule with extrapolation; controls its step
    kAdamsBashforth,  ///< 4 steps, started by Runge-Kutta 4
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

/// Options of all methods. Each method uses those that apply to it.
struct IntegratorOptions {
    Method method = Method::kImplicitEuler;
    double step_s = 1.0 / 60;  ///< the first step when the method controls its step   (0, inf)
    /// Cash-Karp and Bulirsch-Stoer: allowed error of one step, as a fraction of the scale of each coordinate (length_scale_m
    /// for positions, length_scale_m / step for velocities). 0: fixed step (Bulirsch-Stoer: 1e-6).
    double tolerance = 0;
    double length_scale_m = 1;  ///< size of the body; the unit of errors and of divergence
    double min_step_s = 1e-9;   ///< a controlled step that falls below this counts as divergence
    double diverged_at = 1e3;   ///< a node is this many length scales from its start: diverged
    /// Maximum per implicit step; ten times as many per equilibrium, which goes through pseudo-time.
    int newton_iterations = 20;
    /// Stop when no node moves more than this fraction of the length scale.
    double newton_tolerance = 1e-8;
    /// For implicit Euler; kBaraffWitkin tries the exact one first.
    Curvature curvature = Curvature::kPositive;
    LinearSolver linear = LinearSolver::kDirect;
    /// Terzopoulos: the stiffness contains the strain rate of the step's start.
    bool lag_rate = false;
};

/// Cost and outcome of advancing. No convergence and divergence are results, not errors.
struct IntegratorReport {
    long steps = 0;
    long evaluations = 0;  ///< of forces, or of the potential with its gradient
    /// Number of steps that were repeated with a smaller size. For Newton, halvings of the line search and rejected moves. For
    /// kBaraffWitkin, steps whose exact curvature was singular and that were solved with the positive one.
    long rejections = 0;
    long linear_solves = 0;  ///< factorisations or conjugate-gradient runs
    /// Maximum of the accepted steps; implicit: last Newton move, as a fraction of the length scale.
    double error_estimate = 0;
    bool diverged = false;
    double diverged_at_s = std::numeric_limits<double>::quiet_NaN();
    bool converged = true;  ///< every Newton solve met its tolerance

    void add(const IntegratorReport& later);
};

/// Advances the state of a system in time by one method.
class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Forgets the history of multi-step methods and where the motion began. Must be called after the state was changed from
    /// outside. A state whose time differs from where the last advance ended counts as a restart.
    virtual void restart() = 0;

    /// Advances to `until_s` in whole steps; the last step is shortened to end there exactly. Stops when the motion diverges
    /// and leaves the state as it is. An object serves one system and keeps its buffers from step to step.
    virtual IntegratorReport advance(const MotionSystem& system, MotionState& state,
                                     double until_s) = 0;
};

/// Throws std::invalid_argument for options outside their ranges.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options);

}  // namespace risorius::solve
