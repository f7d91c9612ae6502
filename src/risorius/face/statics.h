// SPDX-License-Identifier: MIT
/// \file
/// The equilibrium of a face as a system of equations: its gradient, its linear solves and its sensitivities.
///
///     g(x, p) = 0,   H = dg/dx,   dx/dp = - H^-1 dg/dp
///
/// - x: node positions, n x 3, m; p: what the equilibrium depends on (activations, kinematic channels, numbers of the rig)
/// - g: gradient of the static energy, n x 3, N; H: tangent stiffness, N/m
///
/// For a number L(x) with b = dL/dx, the adjoint form is dL/dp = - (H^-1 b) . dg/dp.
#pragma once

#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct FaceImpl;

/// A view of a Face, from Face::statics(). It refers to the equilibrium of the last Face::solve_equilibrium(). The channels of
/// the jaw must place the jaw: all functions except nodes() and pull_back() throw std::logic_error while muscles move it.
/// Rows of x are the nodes of the tissue, then those of the volume muscles.
class Statics {
  public:
    explicit Statics(FaceImpl& face) : face_(&face) {}

    /// Current node positions x, n x 3, m. The reference changes with the next step or equilibrium.
    const Points& nodes() const;

    /// Returns g at any nodes, activation (per column) and drive, n x 3, N. It is zero in equilibrium and on fixed nodes.
    Points gradient(const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive) const;

    /// Returns H^-1 b, n x 3, at the equilibrium. H is factored at the first call after an equilibrium.
    Points solve(const Points& b) const;

    /// Returns the derivatives of all vertices of the mesh, V x 3 each, in m per unit: by the activation of each of `columns`,
    /// then by each of `channels`. Lids that a column moves are included. At the kink of a lid's levator the derivative is the
    /// mean of both sides.
    std::vector<Points> sensitivities(std::span<const int> columns,
                                      std::span<const track::Kinematic> channels) const;

    /// Returns b = dL/dx, n x 3, for a given dL/d(vertices), V x 3, with bones and lids held. Wrinkles are left out.
    Points pull_back(const Points& vertex_gradient) const;

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
