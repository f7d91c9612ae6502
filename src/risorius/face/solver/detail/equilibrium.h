// SPDX-License-Identifier: MIT
/// \file
/// A face at rest under what drives it, and how that equilibrium answers to its drive.
///
///   g(x, p) = 0   at the nodes x in equilibrium with a drive p; H = dg/dx
///   dx/dp = - H^-1 dg/dp          v(x, p) vertices of the mesh, dv/dp = v_x dx/dp + v_p
///   of a number L(x) with slope b = dL/dx:   dL/dp = - (H^-1 b) . dg/dp, whatever p is
///
/// One factor of H serves them all. In H contact planes are those of the pose; that they turn as tissue slides over them is put
/// right in dx/dp by a few more solves with the same factor.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/static_solver.h"
#include "risorius/track/channels.h"

namespace risorius::face {

class Equilibrium {
  public:
    /// Puts bones, lids and air of the tissue where the drive wants them.
    using Prescribe =
        std::function<void(const Eigen::VectorXd& activation, const track::Drive& drive)>;
    /// Vertices of the mesh for nodes and a drive.
    using Vertices = std::function<Points(const Points& x, const Eigen::VectorXd& activation,
                                          const track::Drive& drive)>;
    /// What is in equilibrium.
    struct Pose {
        const Points& x;
        const Eigen::VectorXd& activation;
        const track::Drive& drive;
    };

    /// Keeps references to all. `least` is the lower limit of each column.
    Equilibrium(FaceTissue& tissue, Prescribe set_boundary_conditions, Vertices vertices,
                Eigen::VectorXd min);

    /// Moves x to the equilibrium; the tissue must be prescribed.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const StaticOptions& options,
                                Points& x);
    /// The pose is no longer the one last factored.
    void moved() { factored_ = false; }
    void forget() {
        moved();
        solver_.forget();
    }

    /// g at any nodes for any drive; zero on fixed nodes. Leaves the tissue prescribed as in `pose`.
    Points gradient(const Pose& pose, const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive);
    Points solve(const Pose& pose, const Points& b);  ///< H^-1 b, both over nodes
    /// dv/dp per unit of each: activations first, then channels.
    std::vector<Points> sensitivities(const Pose& pose, std::span<const int> columns,
                                      std::span<const track::Kinematic> channels);

  private:
    /// Prescribes the pose, finds its contacts and factors H, unless that was done.
    void prepare(const Pose& pose);

    FaceTissue& tissue_;
    Prescribe prescribe_;
    Vertices vertices_;
    Eigen::VectorXd min_;
    StaticSolver solver_;
    bool factored_ = false;
};

}  // namespace risorius::face
