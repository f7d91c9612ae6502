// SPDX-License-Identifier: MIT
/// \file
/// Time integration of the tissue in the moving frame of the head, by BDF2 (second-order backward difference formula).
///
///     x_{n+1} = b_x + h' v_{n+1},   v_{n+1} = b_v + h' a_{n+1},   b = (4 (.)_n - (.)_{n-1}) / 3,   h' = 2h/3
///
/// - x, v, a: position, velocity and acceleration through space, in the head frame of their step; h: step, s
/// - H_n: pose of the head at step n, world from head; M = H_{n+1}^-1 H_n: motion of a point at rest in space, seen from the head
///
/// M carries positions and velocities of former steps into the new frame. So all inertial forces of a moving head (linear, angular,
/// centrifugal, Coriolis) are included to second order. A BDF2 step equals an implicit Euler step of length h' from b_x without
/// forces reaching b_x + h' b_v.
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, V.1.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

/// Maximum acceleration of the head that the tissue feels, ten times gravity. Scripts may let the head jump.
inline constexpr double kMaxFelt_m_s2 = 98.1;

class TissueMotion {
  public:
    TissueMotion(const Neck& neck, const Points& rest, double step_s);

    /// Starts at rest, in space and in the head frame. x: n x 3, m.
    void start(const Points& x, const Rigid& head);

    double effective_step_s() const { return 2 * step_s_ / 3; }  ///< h'

    struct Step {
        Points start;  ///< b_x without the motion of the head, n x 3, m: strain rates refer to it
        Points aim;    ///< b_x + h' b_v, n x 3, m
        Points expected;                  ///< linear extrapolation within the head frame, n x 3, m
        Rigid moved = Rigid::Identity();  ///< M
    };
    const Step& begin(const Rigid& head);
    void end(const Points& x);

    /// Returns the velocity within the head frame, n x 3, m/s.
    Points velocity() const { return (now_ - before_) / step_s_; }

  private:
    Rigid felt(const Rigid& head);

    const Neck& neck_;
    double step_s_;
    std::vector<double> fraction_;  ///< per node, fraction of the head's motion that it follows
    Points now_, before_;           ///< positions in the head frame, m
    Points space_now_, space_before_, velocity_, velocity_before_;
    Rigid head_ = Rigid::Identity(), next_head_ = Rigid::Identity();
    Rigid moved_before_ = Rigid::Identity();
    Step step_;
};

}  // namespace risorius::face
