// SPDX-License-Identifier: MIT
/// \file
/// The classic Runge-Kutta step of order 4. It also starts the multi-step methods.
#pragma once

#include "risorius/solve/motion_system.h"

namespace risorius::solve::detail {

/// Makes single steps. It keeps its buffers between steps.
class RungeKutta4Step {
  public:
    /// Advances x and v by a step of h seconds. `a` is the acceleration at t, m/s^2. Evaluates the acceleration three more
    /// times.
    void apply(const MotionSystem& system, double t_s, double h, const Points& a, Points& x,
               Points& v);

  private:
    Points stage_, v2_, v3_, v4_, a2_, a3_, a4_;
};

}  // namespace risorius::solve::detail
