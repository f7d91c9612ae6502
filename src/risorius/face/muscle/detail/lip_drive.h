// SPDX-License-Identifier: MIT
/// \file
/// The effect of the volume of orbicularis oris on the lips, in addition to the pull of its fibres. The inner and the marginal part of the
/// muscle lie in the inner lip, which the tissue mesh leaves out (shell.h).
///
///   r = max(0, marginal - peripheral)   the J-shaped marginal part curls the red lip inwards over the teeth
///   p = max(0, peripheral - marginal)   the deep peripheral part thickens between teeth and lip and pushes it forwards
///
/// marginal, peripheral: activations, 0..1; each lip has its own. In the plane across the lip, the rest position X of a node is turned by
/// r w theta about an axis on the teeth and projected onto the teeth; this gives the target t. w is a weight of the node, theta the maximum
/// angle. e is the direction of the axis, from right to left; along it there is no force. n points outwards, and d is the distance, m, by
/// which the fully thickened muscle pushes. k and k' are stiffnesses per node, N/m.
///   E = sum r k/2 |(I - e e^T)(x - t)|^2 + sum p k'/2 min(0, (x - X) . n - (1 - (1 - p)^3) d)^2
/// Targets follow the same fraction of the mandible's motion as the tissue there.
/// Sources: Blair & Smith 1986 (marginal against peripheral part); angles and distances from measured expression scans.
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

/// The two energies above, for the nodes of both lips.
class LipDrive {
  public:
    LipDrive(const rig::Head& head, const rig::RigDescription& rig, const Shell& shell,
             const TissueMesh& mesh, const std::vector<Attachment>& attachments);

    /// Sets the factors on the turn and the push of both lips, relative to the standard head.
    void scale(const rig::LipsDescription& lips);
    /// Keeps only nodes that `row` maps to 0..`rows` - 1, and gives them these numbers.
    void keep(const std::vector<int>& row, int rows);

    /// Sets how far each lip is turned and pushed, from the activation per column, 0..1.
    void drive(const Eigen::VectorXd& activation);
    /// Sets targets and directions for this motion of the mandible; within a step only the targets move.
    void set_mandible(const Rigid& mandible);
    void move_mandible(const Rigid& mandible);

    /// Returns E(x), J, and adds dE/dx to `gradient` (N).
    double add_energy(const Points& x, Points& gradient) const;
    /// Adds dE/d(motion of the mandible), N and N m.
    void add_mandible_gradient(const Points& x, Wrench& sum) const;
    void add_metric(solve::MetricBuilder& builder) const;
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

  private:
    enum { kUpper, kLower };
    struct Turned {
        int node, lip;
        double jaw, weight, stiffness;
        Vec3 rest, axis;  // axis: a point of the axis, which runs from right to left
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
