// SPDX-License-Identifier: MIT
/// \file
/// The equilibrium of a face under a drive, and its derivatives by the drive. The public view is statics.h.
///
///     g(x, p) = 0,   H = dg/dx,   dx/dp = - H^-1 dg/dp,   dv/dp = v_x dx/dp + v_p
///     for a scalar function L(x) with b = dL/dx:   dL/dp = - (H^-1 b) . dg/dp
///
/// - x: nodes, n x 3, m; p: an activation or a channel of the drive; g: gradient of the static energy, n x 3, N
/// - v(x, p): vertices of the mesh, V x 3, m; v_x, v_p: its derivatives by x and p
///
/// All derivatives use one factorisation of H. H treats contact planes as fixed, but they turn as tissue slides over them. A few more
/// solves with the same factorisation correct dx/dp for that.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/static_solver.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// Finds equilibria of one face and differentiates them.
class Equilibrium {
  public:
    /// Sets the boundary conditions of the tissue (bones, lids, mouth pressure, weight) for activation and drive.
    using Prescribe =
        std::function<void(const Eigen::VectorXd& activation, const track::Drive& drive)>;
    /// Returns the vertices of the mesh, V x 3, m, for nodes and drive.
    using Vertices = std::function<Points(const Points& x, const Eigen::VectorXd& activation,
                                          const track::Drive& drive)>;
    /// A state in equilibrium.
    struct Pose {
        const Points& x;
        const Eigen::VectorXd& activation;
        const track::Drive& drive;
    };

    /// Keeps a reference to the tissue. `min` is the lower limit of each column of the activation.
    Equilibrium(FaceTissue& tissue, Prescribe set_boundary_conditions, Vertices vertices,
                Eigen::VectorXd min);

    /// Moves x to the equilibrium. The boundary conditions must be set.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const StaticOptions& options,
                                Points& x);
    /// Says that the pose or the forces have changed, so that the factorisation of H is out of date.
    void moved() { factored_ = false; }
    /// Forgets all factorisations, so that the next equilibrium depends on its arguments alone. `near`: it begins in another one.
    void forget(bool near = false) {
        moved();
        solver_.forget(near);
    }

    /// Returns g at any nodes for any drive, n x 3, N; zero on fixed nodes. Afterwards the boundary conditions are those of `pose`.
    Points gradient(const Pose& pose, const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive);
    /// Returns H^-1 b, n x 3.
    Points solve(const Pose& pose, const Points& b);
    /// Returns dv/dp, V x 3 each, m per unit: by the activations of `columns`, then by `channels`.
    std::vector<Points> sensitivities(const Pose& pose, std::span<const int> columns,
                                      std::span<const track::Kinematic> channels);

  private:
    /// Sets the boundary conditions of the pose, finds its contacts, and factorises H unless the factorisation is up to date.
    void prepare(const Pose& pose);

    FaceTissue& tissue_;
    Prescribe prescribe_;
    Vertices vertices_;
    Eigen::VectorXd min_;
    StaticSolver solver_;
    bool factored_ = false;
};

}  // namespace risorius::face
