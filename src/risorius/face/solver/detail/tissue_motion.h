// SPDX-License-Identifier: MIT
/// \file
/// Time integration of the tissue in the moving frame of the head, by BDF2 (second-order backward difference formula).
///
///     x_{n+1} = b_x + h' v_{n+1},   v_{n+1} = b_v + h' a_{n+1},   b_y = (4 y_n - y_{n-1}) / 3 for y = x and v,   h' = 2h/3
///
/// - x, v, a: position, m, velocity, m/s, and acceleration, m/s^2, relative to space, in the head frame of their step; h: step, s
/// - H_n: pose of the head at step n, world from head; M = H_{n+1}^-1 H_n: motion, in the head frame, of a point that rests in space
///
/// M transforms positions and velocities of former steps to the new head frame. So all inertial forces of a moving head (linear, angular,
/// centrifugal, Coriolis) are included to second order. A BDF2 step equals an implicit Euler step of length h' from b_x without
/// forces reaching b_x + h' b_v.
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, V.1.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

/// Maximum acceleration of the head that acts on the tissue, ten times gravity. It limits the forces when a script makes the head jump.
inline constexpr double kMaxFelt_m_s2 = 98.1;

/// The former steps of the tissue of one face. Functions are called as start(), then begin() and end() for each step.
class TissueMotion {
  public:
    /// Keeps a reference to `neck`. `rest`: positions at rest, n x 3, m.
    TissueMotion(const Neck& neck, const Points& rest, double step_s);

    /// Starts with zero velocity, relative to space and to the head. `x`: n x 3, m; `head`: motion of the head from rest.
    void start(const Points& x, const Rigid& head);

    double effective_step_s() const { return 2 * step_s_ / 3; }  ///< h'

    /// Positions from which a step is computed, in its head frame.
    struct Step {
        Points start;  ///< b_x without the motion of the head, n x 3, m: reference of strain rates
        Points aim;    ///< b_x + h' b_v, n x 3, m
        Points expected;                  ///< linear extrapolation within the head frame, n x 3, m
        Rigid moved = Rigid::Identity();  ///< M
    };
    /// Begins a step at whose end the motion of the head from rest is `head`.
    const Step& begin(const Rigid& head);
    /// Ends the step with the positions x that were found, n x 3, m.
    void end(const Points& x);

    /// Returns the velocity within the head frame, n x 3, m/s.
    Points velocity() const { return (past_.now - past_.before) / step_s_; }

    /// What the next step depends on.
    struct Past {
        Points now, before;  ///< positions in the head frame, n x 3, m
        Points space_now, space_before, velocity, velocity_before;
        Rigid head = Rigid::Identity(), moved_before = Rigid::Identity();
    };
    const Past& past() const { return past_; }
    void go_back_to(const Past& past) { past_ = past; }

  private:
    Rigid felt(const Rigid& head);

    const Neck& neck_;
    double step_s_;
    std::vector<double> fraction_;  ///< per node, fraction of the head's motion that it follows
    Past past_;
    Rigid next_head_ = Rigid::Identity();
    Step step_;
};

}  // namespace risorius::face
