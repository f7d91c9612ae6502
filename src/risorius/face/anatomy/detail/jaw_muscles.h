// SPDX-License-Identifier: MIT
/// \file
/// The muscles of jaw and hyoid: Hill-type muscles along lines of action between skull, mandible and hyoid.
///
///   L   length of the path, m        tendons rigid: fibre along the path L - slack, l = sqrt((L - slack)^2 + (l0 sin alpha)^2)
///   T = F0 [ a fl(l_n) fv(l') + fp(l) + b l' ],  l' = (l - l_n) / (h vmax l0)   (l_n: start of the step; see musculotendon.h)
/// l0 and slack of the table are scaled together, so that the fibres of every head have the table's relative length at rest.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// Factor on the force of the table, which assumes 40 N/cm2 for all muscles. With that the incisors would bite with 540 N, with this
/// factor with 350 N; 150 to 400 N are measured.
inline constexpr double kJawForceFraction = 0.65;
/// Passive stiffness of relaxed jaw muscles: 1.5 % of F0 at 1.5 times the length (Peck et al. 2000). With more, no jaw could open wide.
inline constexpr double kJawPassiveStrain = 2.0;

struct JawMuscle {
    struct Point {
        Vec3 rest;
        rig::PathPoint::Body body;  ///< skull, mandible or hyoid
    };
    std::string id;
    Side side = Side::kLeft;
    int column = 0;  ///< of the activation vector
    /// A solid pulls in its place; only its tone at rest is left, since without it the jaw would hang in another position.
    bool tone_only = false;
    double f0_n = 0, optimal_m = 0, slack_m = 0, thickness_m = 0, max_speed_m_s = 0;
    std::vector<Point> path;
};

class JawMuscles {
  public:
    /// Muscles of the groups jaw and hyoid; `solids` names those that keep only their tone.
    JawMuscles(const rig::Head& head, const rig::RigDescription& rig,
               const std::set<std::string>& solids);

    /// Constants of a step, one per muscle.
    struct Drive {
        double active = 0;    ///< a fl(l_n)
        double length_m = 0;  ///< l_n
    };
    std::vector<Drive> drive(const JawPose& pose, const Vec3& hyoid,
                             const Eigen::VectorXd& activation) const;

    /// Adds E, its gradient and a positive approximation of its second derivative for a step of length h.
    double add_energy(const std::vector<Drive>& drive, double h, const JawPose& pose,
                      const Vec3& hyoid, JawVector& gradient, JawMatrix& hessian) const;

    /// Work that isometric contraction at these activations could do, J: sum of a F0 l0 (integral of fl).
    double active_energy_j(const JawPose& pose, const Vec3& hyoid,
                           const Eigen::VectorXd& activation) const;

    const std::vector<JawMuscle>& list() const { return muscles_; }
    /// Isometric tension of a muscle at an activation, N: F0 [a fl + fp].
    double isometric_n(std::size_t muscle, const JawPose& pose, const Vec3& hyoid,
                       double activation) const;
    double fibre_length_m(std::size_t muscle, const JawPose& pose, const Vec3& hyoid) const;

  private:
    std::vector<JawMuscle> muscles_;
    muscle::MuscleCurves curves_;
};

}  // namespace risorius::face
