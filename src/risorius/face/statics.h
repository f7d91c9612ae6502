// SPDX-License-Identifier: MIT
/// \file
/// The equilibrium of a face as a system of equations: its gradient, its linear solves and its sensitivities.
///
///     g(x, p) = 0,   H = dg/dx,   dx/dp = - H^-1 dg/dp
///
/// - x: node positions, n x 3, m; p: a parameter of the equilibrium (an activation, a kinematic channel, a number of the rig)
/// - g: gradient of the static energy, n x 3, N; H: tangent stiffness, N/m
///
/// For a scalar function L(x) with b = dL/dx, the adjoint form is dL/dp = - (H^-1 b) . dg/dp.
#pragma once

#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct FaceImpl;

/// An equilibrium of a face that was kept, to begin another search there.
struct KeptEquilibrium {
    Points nodes;                ///< n x 3, m
    Eigen::VectorXd activation;  ///< per column, 0..1
    track::Drive drive;
};

/// A view of a Face, from Face::statics(). It refers to the equilibrium of the last Face::solve_equilibrium(). The channels of
/// the jaw must place the jaw: all functions except nodes() and pull_back() throw std::logic_error while muscles move it.
/// Rows of x are the nodes of the tissue, then those of the volume muscles.
class Statics {
  public:
    explicit Statics(FaceImpl& face) : face_(&face) {}

    /// Returns the current node positions x, n x 3, m. The next step or equilibrium overwrites them.
    const Points& nodes() const;

    /// Returns a copy of the last equilibrium.
    KeptEquilibrium keep() const;
    /// Puts the face where it, or an equal one, was kept. What it did before has no effect on what it does next, as after Face::start().
    void go_back_to(const KeptEquilibrium& kept);

    /// Returns g, n x 3, N, at any `nodes` (n x 3, m), `activation` (per column, 0..1) and drive. It is zero in equilibrium and on
    /// fixed nodes.
    Points gradient(const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive) const;

    /// Returns H^-1 b, n x 3, at the equilibrium. H is factored at the first call after an equilibrium.
    Points solve(const Points& b) const;

    /// Returns the derivatives of all vertices of the mesh, V x 3 each: first by the activation of each of `columns`, m, then by
    /// each of `channels`, m per unit of the channel. The motion of a lid that a column moves is included. Where the motion of a
    /// lid has a kink (activation 0 of the levator), the derivative is the mean of both sides.
    std::vector<Points> sensitivities(std::span<const int> columns,
                                      std::span<const track::Kinematic> channels) const;

    /// Returns b = dL/dx, n x 3, for the gradient of L by the vertices of the mesh, V x 3. Bones and lids do not move. Wrinkles are
    /// left out.
    Points pull_back(const Points& vertex_gradient) const;

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
