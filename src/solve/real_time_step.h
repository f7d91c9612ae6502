// Implicit Euler for real-time use: a few iterations of L-BFGS on the potential of the step, around a preconditioner.
// Every iteration lowers the potential, so a step cut short is still stable; the count is fixed or ends at a tolerance,
// never at a clock.
//
//   Phi(x) = sum m |x - y|^2 / (2 h^2) + E(x) + h R(x; x_n, h),   y = x_n + h v_n,   v = (x - x_n) / h
//
// Liu, Bouaziz & Kavan 2017, ACM TOG 36(3).
#pragma once

#include <memory>

#include "solve/motion_system.h"
#include "solve/preconditioner.h"
#include "solve/quasi_newton.h"

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

    /// One step of options.step_s. Not converging is a result.
    StepReport advance(MotionState& state);

  private:
    const MotionSystem& system_;
    std::shared_ptr<Preconditioner> preconditioner_;
    RealTimeOptions options_;
    QuasiNewton solver_;
    Points start_, inertial_, x_, left_, acceleration_, before_;
    int history_ = 0;
};

}  // namespace risorius::solve
