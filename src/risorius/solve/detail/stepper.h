// SPDX-License-Identifier: MIT
/// \file
/// The common part of all methods: the times of the steps, the start of the history, and the check for divergence.
#pragma once

#include "risorius/solve/integrator.h"

namespace risorius::solve::detail {

/// Stores where a motion began, and detects whether a state continues the last one.
class DivergenceMonitor {
  public:
    explicit DivergenceMonitor(const IntegratorOptions& options);

    void restart() { left_at_s_ = std::numeric_limits<double>::quiet_NaN(); }

    /// Returns true when the time of `state` is not that of the last end(). Then the history does not apply.
    bool begin(const MotionState& state);
    void end(const MotionState& state) { left_at_s_ = state.t_s; }

    /// True when a value is not finite or a node is too far from its first position.
    bool diverged(const Points& x, const Points& v) const;

  private:
    double farthest_squared_;
    double left_at_s_;
    Points began_;
};

/// A method with fixed steps. Steps end at the times origin + k h. So several calls of advance() make the same steps as one
/// call, when they end at such times.
class Stepper : public Integrator {
  public:
    explicit Stepper(const IntegratorOptions& options);

    void restart() override;
    IntegratorReport advance(const MotionSystem& system, MotionState& state,
                             double until_s) override;

  protected:
    /// Advances x and v by one step of h seconds from t. The fixed nodes have their positions at t; the caller moves them to
    /// those at t + h afterwards. The function may set report.diverged.
    virtual void step(const MotionSystem& system, Points& x, Points& v, double t_s, double h,
                      IntegratorReport& report) = 0;
    /// Drops the history of earlier steps.
    virtual void forget() {}

    const IntegratorOptions options_;

  private:
    DivergenceMonitor monitor_;
    double origin_s_ = 0;
    long count_ = 0;
};

/// A method that controls its step size. A step is repeated with a smaller size until its error is allowed.
class ControlledStepper : public Integrator {
  public:
    explicit ControlledStepper(const IntegratorOptions& options);

    void restart() override;
    IntegratorReport advance(const MotionSystem& system, MotionState& state,
                             double until_s) override;

  protected:
    struct Attempt {
        /// Error of the step divided by the allowed error. The step is accepted when it is at most 1; NaN is not accepted.
        double error;
        double next_s;  ///< size of the next step, or of the repetition of this one
    };
    /// Tries a step of h seconds from t. The result is in trial_x_ and trial_v_. `first` is true for the first attempt of a
    /// step, and false for its repetitions.
    virtual Attempt attempt(const MotionSystem& system, const Points& x, const Points& v,
                            double t_s, double h, bool first, IntegratorReport& report) = 0;
    virtual void forget() {}

    /// The error (dx, dv) of a step of h seconds, divided by the allowed error. NaN if any entry is NaN.
    double scaled_error(const Points& dx, const Points& dv, double h) const;

    const IntegratorOptions options_;
    const double tolerance_;
    Points trial_x_, trial_v_;

  private:
    DivergenceMonitor monitor_;
    double step_s_;
};

}  // namespace risorius::solve::detail
