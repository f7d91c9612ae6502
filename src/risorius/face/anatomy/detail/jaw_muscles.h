// SPDX-License-Identifier: MIT
/// \file
/// The muscles of jaw and hyoid: Hill-type muscles along lines of action between skull, mandible and hyoid.
///
///   L    length of the path from origin to insertion, m       slack   length of the rigid tendon, m
///   l    length of the fibre: l = sqrt((L - slack)^2 + (l0 sin alpha)^2),   l0 optimal length, alpha pennation angle
///   T = F0 [ a fl(l_n) fv(l') + fp(l) + b l' ],  l' = (l - l_n) / (h vmax l0)
///   T    tension, N      F0   maximum isometric force, N     a   activation      l_n  length at the start of the step
///   h    step, s         vmax maximum speed, l0 per s        b   damping         fl, fv, fp  curves, see musculotendon.h
///
/// l0 and slack of the table are scaled by one factor per muscle, so that fibres have the table's l / l0 at rest in every head.
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

/// Shape of the passive curve of relaxed jaw muscles: the passive force is 1.5 % of F0 at 1.5 times the length (Peck et al. 2000).
inline constexpr double kJawPassiveStrain = 2.0;

/// The same for volume muscles of the jaw, whose fibres add next to nothing: their matrix pulls along the fibres by `stretch_along_pa`. At
/// 1.5 times the length that is 13.5 kPa, where the 1.5 % are 6 kPa.
inline constexpr double kJawVolumePassiveStrain = 10;

/// One side of a muscle of jaw or hyoid on one head.
struct JawMuscle {
    struct Point {
        Vec3 rest;                  ///< m, head frame
        rig::PathPoint::Body body;  ///< skull, mandible or hyoid
    };
    std::string id;
    Side side = Side::kLeft;
    int column = 0;  ///< of the activation vector
    /// A volume muscle pulls in its place. Only its tone at rest is kept, since without it the jaw would rest in another position.
    bool tone_only = false;
    double f0_n = 0, optimal_m = 0, slack_m = 0, thickness_m = 0, max_speed_m_s = 0;
    std::vector<Point> path;
};

/// All jaw and hyoid muscles of one head. `hyoid` is the displacement of the hyoid from rest, m.
class JawMuscles {
  public:
    /// Takes the muscles of the groups jaw and hyoid from the rig. `solids` names those that keep only their tone.
    JawMuscles(const rig::Head& head, const rig::RigDescription& rig,
               const std::set<std::string>& solids);

    /// Constants of a step, one per muscle.
    struct Drive {
        double active = 0;    ///< a fl(l_n)
        double length_m = 0;  ///< l_n
    };
    std::vector<Drive> drive(const JawPose& pose, const Vec3& hyoid,
                             const Eigen::VectorXd& activation) const;

    /// Returns the energy E, J, whose derivative by the length of each path is T, for a step of length h, s. Adds its gradient and a
    /// positive approximation of its second derivative.
    double add_energy(const std::vector<Drive>& drive, double h, const JawPose& pose,
                      const Vec3& hyoid, JawVector& gradient, JawMatrix& hessian) const;

    /// Returns the active energy at these activations, J: the sum of a F0 l0 (integral of fl).
    double active_energy_j(const JawPose& pose, const Vec3& hyoid,
                           const Eigen::VectorXd& activation) const;

    const std::vector<JawMuscle>& list() const { return muscles_; }
    /// Returns the isometric tension of a muscle (index into list()) at an activation, N: F0 [a fl + fp].
    double isometric_n(std::size_t muscle, const JawPose& pose, const Vec3& hyoid,
                       double activation) const;
    double fibre_length_m(std::size_t muscle, const JawPose& pose, const Vec3& hyoid) const;

  private:
    std::vector<JawMuscle> muscles_;
    muscle::MuscleCurves curves_;
};

}  // namespace risorius::face
