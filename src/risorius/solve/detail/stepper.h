// SPDX-License-Identifier: MIT
/// \file
/// What all methods share: the clock of whole steps, the start of the history, and the watch for divergence.
#pragma once

#include "risorius/solve/integrator.h"

namespace risorius::solve::detail {

/// Remembers where a motion began and whether it is continued where it was left.
class ProgressMonitor {
  public:
    explicit ProgressMonitor(const IntegratorOptions& options);

    void restart() { left_at_s_ = std::numeric_limits<double>::quiet_NaN(); }

    /// True when `state` is not where the last advance left it: the history means nothing then.
    bool begin(const MotionState& state);
    void end(const MotionState& state) { left_at_s_ = state.t_s; }

    /// Not finite, or a node too far from where it began.
    bool diverged(const Points& x, const Points& v) const;

  private:
    double farthest_squared_;
    double left_at_s_;
    Points began_;
};

/// A method of fixed steps. Time runs on the grid origin + k h, so that advancing in pieces repeats the same steps.
class Stepper : public Integrator {
  public:
    explicit Stepper(const IntegratorOptions& options);

    void restart() override;
    IntegratorReport advance(const MotionSystem& system, MotionState& state,
                             double until_s) override;

  protected:
    /// One step of h from t, in place; fixed nodes are where they belong at t, and are put there at t + h afterwards. May
    /// set report.diverged.
    virtual void step(const MotionSystem& system, Points& x, Points& v, double t_s, double h,
                      IntegratorReport& report) = 0;
    /// Drops the history of earlier steps.
    virtual void forget() {}

    const IntegratorOptions options_;

  private:
    ProgressMonitor monitor_;
    double origin_s_ = 0;
    long count_ = 0;
};

/// A method that chooses its step. A step is repeated smaller until its error is allowed.
class ControlledStepper : public Integrator {
  public:
    explicit ControlledStepper(const IntegratorOptions& options);

    void restart() override;
    IntegratorReport advance(const MotionSystem& system, MotionState& state,
                             double until_s) override;

  protected:
    struct Attempt {
        double
            error;  ///< of the whole step in units of what is allowed: up to 1 is accepted, NaN is not
        double next_s;  ///< step to try next, or to repeat this one with
    };
    /// Tries h from t and leaves the result in trial_x_, trial_v_. `first` says that x and v are new.
    virtual Attempt attempt(const MotionSystem& system, const Points& x, const Points& v,
                            double t_s, double h, bool first, IntegratorReport& report) = 0;
    virtual void forget() {}

    /// Error of (dx, dv) over a step of h in units of what is allowed; NaN if one of them is.
    double scaled_error(const Points& dx, const Points& dv, double h) const;

    const IntegratorOptions options_;
    const double tolerance_;
    Points trial_x_, trial_v_;

  private:
    ProgressMonitor monitor_;
    double step_s_;
};

}  // namespace risorius::solve::detail
