// SPDX-License-Identifier: MIT
/// \file
/// The nodes' own motion through space while the head moves: what a step in the frame of the head aims at.
///
///   H_n   head at step n, world from head          M = H_{n+1}^-1 H_n   what was at rest in space, seen from the next step
///   x     positions, v velocities through space, both in the frame of the head of their step
/// By the second backward difference (BDF2), with h' = 2h/3 and everything of former steps carried by M into the new frame,
///   x_{n+1} = b_x + h' v_{n+1},  v_{n+1} = b_v + h' a_{n+1},    b = (4 (.)_n - (.)_{n-1}) / 3
/// which is a step of implicit Euler of length h' from b_x that aims at b_x + h' b_v. Inertial forces of a head that turns or
/// shakes (linear, angular, centrifugal, Coriolis) are in M, to the same order; none has to be written down.
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, V.1.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

/// A head that a script makes jump is felt no harder than this: ten times its weight.
inline constexpr double kMaxFelt_m_s2 = 98.1;

class TissueMotion {
  public:
    TissueMotion(const Neck& neck, const Points& rest, double step_s);

    /// At rest in space and in the head.
    void start(const Points& x, const Rigid& head);

    double effective_step_s() const { return 2 * step_s_ / 3; }  ///< h'

    struct Step {
        Points start;     ///< b_x without the head's motion: tissue is strained from here
        Points aim;       ///< b_x + h' b_v
        Points expected;  ///< where the nodes will be if they go on as they did within the head
        Rigid moved = Rigid::Identity();  ///< M
    };
    const Step& begin(const Rigid& head);
    void end(const Points& x);

    /// Within the head, m/s.
    Points velocity() const { return (now_ - before_) / step_s_; }

  private:
    Rigid felt(const Rigid& head);

    const Neck& neck_;
    double step_s_;
    std::vector<double> fraction_;  ///< of the head's motion, by node
    Points now_, before_;           ///< within the head
    Points space_now_, space_before_, velocity_, velocity_before_;
    Rigid head_ = Rigid::Identity(), next_head_ = Rigid::Identity();
    Rigid moved_before_ = Rigid::Identity();
    Step step_;
};

}  // namespace risorius::face
