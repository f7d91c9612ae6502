// SPDX-License-Identifier: MIT
/// \file
/// Implicit Euler for real-time use: a few iterations of L-BFGS on the potential of the step, with a preconditioner, starting
/// from the position to which the last acceleration would lead.
///
///   Phi(x) = sum m |x - y|^2 / (2 h^2) + E(x) + h R(x; x_n, h),   y = x_n + h v_n,   v = (x - x_n) / h
///
/// Every iteration lowers Phi. A step always ends with Phi(x) <= Phi(x_n) = E(x_n) + sum m |v_n|^2 / 2, even after few
/// iterations. So a bad starting point does not make the motion unstable. The number of iterations is fixed or determined by a
/// tolerance, never by the time that is used.
///
/// Source: Liu, Bouaziz & Kavan 2017, ACM TOG 36(3).
#pragma once

#include <memory>

#include "risorius/solve/motion_system.h"
#include "risorius/solve/preconditioner.h"
#include "risorius/solve/quasi_newton.h"

namespace risorius::solve {

/// Limits of each step.
struct RealTimeOptions {
    double step_s = 1.0 / 60;  ///< h    (0, inf)
    int iterations = 5;        ///< maximum per step
    int memory = 5;            ///< number of pairs of L-BFGS
    /// The iteration ends when it moves the nodes by less than this fraction of the motion of the whole step (both RMS); 0:
    /// never.
    double accuracy = 0;
    double length_scale_m = 1;  ///< size of the body: no iteration moves a node farther   (0, inf)
};

/// Steps one system in time.
class RealTimeStep {
  public:
    /// `system` must outlive the object. Throws std::invalid_argument for options outside their ranges.
    RealTimeStep(const MotionSystem& system, std::shared_ptr<Preconditioner> preconditioner,
                 const RealTimeOptions& options);

    /// Advances `state` by one step of options.step_s. Missing convergence is a result; no exception is thrown. When `state` is
    /// the result of the previous step, the search begins at the positions to which the acceleration of that step would lead.
    StepReport advance(MotionState& state);

  private:
    double potential(const ImplicitStep& step, const Points& x, Points& gradient) const;
    StepReport minimise(const ImplicitStep& step, Points& x);

    const MotionSystem& system_;
    std::shared_ptr<Preconditioner> preconditioner_;
    RealTimeOptions options_;
    QuasiNewton solver_;
    Points start_, inertial_, x_;
    Points left_x_, left_v_, acceleration_;  ///< of the previous step
};

}  // namespace risorius::solve
