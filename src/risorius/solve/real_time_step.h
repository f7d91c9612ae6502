// SPDX-License-Identifier: MIT
/// \file
/// Implicit Euler for real-time use: a few iterations of L-BFGS on the potential of the step, around a preconditioner, from
/// where the last acceleration would lead.
///
///   Phi(x) = sum m |x - y|^2 / (2 h^2) + E(x) + h R(x; x_n, h),   y = x_n + h v_n,   v = (x - x_n) / h
///
/// Every iteration lowers Phi, and however short it is cut, a step ends with Phi(x) <= Phi(x_n) = E(x_n) + m v_n^2 / 2: a bad
/// beginning does no harm. The count of iterations is fixed or ends at a tolerance, never at a clock.
///
/// Liu, Bouaziz & Kavan 2017, ACM TOG 36(3).
#pragma once

#include <memory>

#include "risorius/solve/motion_system.h"
#include "risorius/solve/preconditioner.h"
#include "risorius/solve/quasi_newton.h"

namespace risorius::solve {

struct RealTimeOptions {
    double step_s = 1.0 / 60;  ///< h    (0, inf)
    int iterations = 5;        ///< at most, per step
    int memory = 5;            ///< pairs of L-BFGS
    double accuracy = 0;  ///< stop when an iteration moves the nodes less than this share of the
                          ///< step's motion (both RMS); 0 = never
    double length_scale_m = 1;  ///< of the body: no iteration moves a node farther   (0, inf)
};

class RealTimeStep {
  public:
    /// The system must outlive it. Throws std::invalid_argument for options outside their ranges.
    RealTimeStep(const MotionSystem& system, std::shared_ptr<Preconditioner> preconditioner,
                 const RealTimeOptions& options);

    /// One step of options.step_s. Not converging is a result. The acceleration of the step before is where the search
    /// begins if `state` is as that step left it.
    StepReport advance(MotionState& state);

  private:
    double potential(const ImplicitStep& step, const Points& x, Points& gradient) const;
    StepReport minimise(const ImplicitStep& step, Points& x);

    const MotionSystem& system_;
    std::shared_ptr<Preconditioner> preconditioner_;
    RealTimeOptions options_;
    QuasiNewton solver_;
    Points start_, inertial_, x_;
    Points left_x_, left_v_, acceleration_;  ///< of the step before
};

}  // namespace risorius::solve
