// SPDX-License-Identifier: MIT
/// \file
/// Steps a system of nodes in time: eight explicit methods, three implicit ones and equilibrium, behind one interface.
///
///   y = (x, v)      h   step, s      h_max of a linear mode: Press et al., Numerical Recipes; Hairer, Norsett & Wanner
///
/// Cash & Karp 1990, ACM TOMS 16(3); Bulirsch & Stoer after Gragg's modified midpoint rule; Terzopoulos, Platt, Barr &
/// Fleischer 1987; Baraff & Witkin 1998.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/solve/motion_system.h"

namespace risorius::solve {

enum class Method {
    kEuler,        ///< explicit, order 1
    kVerlet,       ///< Stoermer's two-step form; velocity by backward difference feeds the damping
    kRungeKutta2,  ///< midpoint
    kRungeKutta4,  ///< classic
    kCashKarp,     ///< order 5; with a tolerance it controls its step by the embedded order 4
    kBulirschStoer,   ///< modified midpoint with extrapolation, controls its step
    kAdamsBashforth,  ///< 4 steps, started by Runge-Kutta 4
    kAdamsMoulton,    ///< predictor-corrector (PECE) of order 4
    kTerzopoulos,     ///< semi-implicit: stiffness of the step's start, one linear solve
    kBaraffWitkin,    ///< implicit Euler with one linear solve
    kImplicitEuler,   ///< implicit Euler solved by Newton with line search
    kQuasiStatic      ///< equilibrium at each time asked for; velocities stay zero
};

/// "euler", "verlet", "rk2", "rk4", "rkck", "bulirsch-stoer", "adams-bashforth", "adams-moulton", "terzopoulos",
/// "baraff-witkin", "implicit-euler", "quasi-static".
const std::vector<std::string_view>& method_names();
Method method_named(std::string_view name);  ///< throws std::invalid_argument
std::string_view name_of(Method method);
bool is_explicit(Method method);

enum class LinearSolver {
    kDirect,    ///< sparse factorisation in every Newton iteration
    kConjugate  ///< conjugate gradients; what large systems need
};

struct IntegratorOptions {
    Method method = Method::kImplicitEuler;
    double step_s = 1.0 / 60;  ///< first step where the method controls it   (0, inf)
    /// Cash-Karp and Bulirsch-Stoer: allowed error of one step, as a share of each coordinate's scale (length_scale_m for
    /// positions, and that over the step for velocities). 0 = fixed step (Bulirsch-Stoer: 1e-6).
    double tolerance = 0;
    double length_scale_m = 1;  ///< of the body, what errors and divergence are measured by
    double min_step_s = 1e-9;   ///< a controlled step below this is divergence
    double diverged_at =
        1e3;  ///< a node farther than this many length scales from its start, or not finite
    int newton_iterations =
        20;  ///< at most, per implicit step; ten times as many per equilibrium, which walks there in pseudo-time
    double newton_tolerance =
        1e-8;  ///< stop when no node moves more than this share of the length scale
    Curvature curvature =
        Curvature::kPositive;  ///< of implicit Euler; kBaraffWitkin tries the exact one first
    LinearSolver linear = LinearSolver::kDirect;
    bool lag_rate =
        false;  ///< Terzopoulos: the strain rate of the step's start is part of the stiffness
};

/// What advancing cost and how it went. Not converging and diverging are results.
struct IntegratorReport {
    long steps = 0;
    long evaluations = 0;  ///< of forces, or of the potential and its gradient
    long rejections =
        0;  ///< steps tried and repeated smaller; for Newton, halvings of its line search and moves refused; for
    ///< kBaraffWitkin, steps whose exact curvature was singular, solved with the positive one
    long linear_solves = 0;  ///< factorisations or conjugate-gradient runs
    double error_estimate =
        0;  ///< the largest of an accepted step; implicit: last Newton move, share of the length scale
    bool diverged = false;
    double diverged_at_s = std::numeric_limits<double>::quiet_NaN();
    bool converged = true;  ///< every Newton solve met its tolerance

    void add(const IntegratorReport& later);
};

class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Forgets the history of multi-step methods and where the motion began; needed after the state was changed from
    /// outside. A state of another time than was left is taken as a restart.
    virtual void restart() = 0;

    /// Advances to `until_s` in whole steps; the last is shortened to end there exactly. A diverged state is left as it is.
    /// One object serves one system; its buffers are kept from step to step.
    virtual IntegratorReport advance(const MotionSystem& system, MotionState& state,
                                     double until_s) = 0;
};

/// Throws std::invalid_argument for options outside their ranges.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options);

}  // namespace risorius::solve
