// SPDX-License-Identifier: MIT
/// \file
/// The volume effect of orbicularis oris on the lips, in addition to the pull of its fibres. Its inner and marginal parts lie in the inner
/// lip, which the tissue mesh leaves out (shell.h).
///
///   r = max(0, marginal - peripheral)   the J-shaped marginal part curls the red lip inwards over the teeth
///   p = max(0, peripheral - marginal)   the deep peripheral part thickens between teeth and lip and pushes it forwards
///
/// Each lip has its own activations. In the plane across the lip, X is turned by r w theta about an axis on the teeth and projected onto
/// the teeth, which gives the target t. n points outwards, and d is the distance that the thickened muscle fills:
///   E = sum r k/2 |(I - e e^T)(x - t)|^2 + sum p k'/2 min(0, (x - X) . n - (1 - (1 - p)^3) d)^2
/// Targets move with the mandible as far as the tissue there does. Sources: Blair & Smith 1986 (marginal against peripheral part);
/// angles and distances from measured expression scans.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
class HessianBuilder;
}

namespace risorius::face {

class LipDrive {
  public:
    LipDrive(const rig::Head& head, const rig::RigDescription& rig, const Shell& shell,
             const TissueMesh& mesh, const std::vector<Attachment>& attachments);

    /// Factors of the turn and the push of both lips at activation 1 on this head, relative to the standard head.
    void scale(const rig::LipsDescription& lips);
    /// Keeps only nodes that `row` maps to rows below `rows`, and renumbers them so.
    void keep(const std::vector<int>& row, int rows);

    /// Sets how far each lip is turned and pushed.
    void drive(const Eigen::VectorXd& activation);
    /// Sets targets and directions for this motion of the mandible; within a step only the targets move.
    void set_mandible(const Rigid& mandible);
    void move_mandible(const Rigid& mandible);

    /// Returns E(x), J, and adds dE/dx to `gradient` (N).
    double add_energy(const Points& x, Points& gradient) const;
    /// dE / d(motion of the mandible), N and N m.
    void add_mandible_gradient(const Points& x, Wrench& sum) const;
    void add_metric(solve::MetricBuilder& builder) const;
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

  private:
    enum { kUpper, kLower };
    struct Turned {
        int node, lip;
        double jaw, weight, stiffness;
        Vec3 rest, axis;  // the axis is a point on the teeth; it runs from right to left
        Vec3 start, target;
    };
    struct Pushed {
        int node, lip;
        double jaw, way, stiffness;
        Vec3 rest, outward;
        Vec3 target, normal;
    };
    Vec3 pull(const Turned& member, const Points& x) const;
    Vec3 pull(const Pushed& member, const Points& x) const;

    std::vector<Turned> turned_;
    std::vector<Pushed> pushed_;
    std::array<int, 2> marginal_, peripheral_;  // columns of the activation
    std::array<double, 2> turn_{}, push_{};     // r and p
    std::array<double, 2> turn_scale_{1, 1}, push_scale_{1, 1};
    Rigid mandible_ = Rigid::Identity();
};

}  // namespace risorius::face
