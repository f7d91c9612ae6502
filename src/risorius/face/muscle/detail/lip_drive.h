// What orbicularis oris does to the lips as a volume, beside the pull of its fibres: its inner and marginal parts lie in the
// inner lip, which the tissue mesh leaves out (shell.h).
//
//   r = max(0, marginal - peripheral)   the J-shaped marginal part curls the red lip inwards over the teeth
//   p = max(0, peripheral - marginal)   the deep peripheral part thickens between teeth and lip and pushes it forwards
//
// Each lip by its own activations. In the plane across the lip, with X turned by r w theta about an axis on the teeth and
// flattened against them to the target t, n outwards, and d the way that the thickened muscle fills:
//   E = sum r k/2 |(I - e e^T)(x - t)|^2 + sum p k'/2 min(0, (x - X) . n - (1 - (1 - p)^3) d)^2
// Targets go with the mandible as far as the tissue there does. Sources: Blair & Smith 1986 (marginal against peripheral
// part); angles and ways as measured on expression scans.
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

    /// How far activation 1 goes on this head, of the standard way; the turn and the push of both lips.
    void scale(const rig::LipsDescription& lips);
    /// Forgets all nodes but those that `row` sends to rows below `rows`, and calls them by these.
    void keep(const std::vector<int>& row, int rows);

    /// How far each lip is turned and pushed, from here on.
    void drive(const Eigen::VectorXd& activation);
    /// Targets and directions with the mandible there; within a step only targets go with it.
    void set_mandible(const Rigid& mandible);
    void move_mandible(const Rigid& mandible);

    /// Returns E(x), J, and adds dE/dx to `gradient`, N.
    double add_energy(const Points& x, Points& gradient) const;
    /// dE/d(motion of the mandible).
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
