// SPDX-License-Identifier: MIT
/// \file
/// Curves of jaw, lips and tongue through the windows of an utterance. Each parameter x(t) is the solution of
///
///   minimise  integral of x''(t)^2 dt + sum over windows of tau^-4 integral over the window of (x(t) - T)^2 dt
///   subject to  lo(t) <= x(t) <= hi(t)
///
/// on a grid of 5 ms. The problem is convex and has one solution. A curve does not leave the range of the neighbouring targets.
#pragma once

#include <Eigen/Core>
#include <array>

#include "risorius/speech/windows.h"

namespace risorius::speech {

inline constexpr double kCurveStep_s = 0.005;
/// The fastest the gap may change, mm/s. Lips in speech reach 200 to 300 mm/s (Lofqvist & Gracco 1997).
inline constexpr double kMaxLipSpeed_mm_s = 350;

struct ArticulationCurves {
    double start_s = 0;  ///< of the first grid point, from the first sample of the sound
    std::array<Eigen::VectorXd, kParameterCount> values;
    Eigen::VectorXd labiodental;  ///< contact of the lower lip with the upper incisors, [0, 1]
    Eigen::VectorXd bounded;      ///< 1 where a closure or a contact must hold, else 0
    bool converged = true;

    long size() const { return labiodental.size(); }
    double time_s(long i) const { return start_s + static_cast<double>(i) * kCurveStep_s; }
    /// Values between grid points are on a cubic through four of them; before the first and after the last they are those.
    double at(Parameter p, double t_s) const;
    double speed_at(Parameter p, double t_s) const;  ///< unit of the parameter per s
    double labiodental_at(double t_s) const;
};

ArticulationCurves curves_of(const ArticulationTargets& targets);

}  // namespace risorius::speech
