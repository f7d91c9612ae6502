// SPDX-License-Identifier: MIT
/// \file
/// A solid with its supports and loads, which known problems (known_problems.h) bring into equilibrium.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "risorius/figures/detail/known_problems.h"
#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"
#include "risorius/tissue/coordinate_guides.h"
#include "risorius/tissue/dead_loads.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::figures {

/// A solid with its loads and fixed nodes, at the positions from which the solver starts.
struct ProblemSetup {
    tissue::CellBody body;
    std::shared_ptr<solve::EnergyTerm> solid;
    std::vector<char> fixed;
    std::vector<tissue::DeadLoads::Load> loads = {};
    Points x;

    ProblemSetup(const tissue::GridShape& grid, const tissue::RestShape& rest,
                 const KnownMaterial& material);

    const Points& rest() const { return body.rest; }
    void fix(int node) { fixed[static_cast<std::size_t>(node)] = 1; }
    /// Keeps one coordinate of a node, by a spring that is so stiff that it hardly gives way.
    void guide(int node, int axis) { guides_.push_back({node, axis, body.rest(node, axis)}); }
    /// Shares `force` among the nodes of a plane of a1 as a traction that is the same everywhere does.
    void load_plane(const tissue::GridShape& grid, int plane, const Vec3& force);

    /// Brings x into equilibrium. Throws RunError.
    void settle();
    /// The force that holds each node, N: dE/dx of the solid alone.
    Points holding() const;

  private:
    double guide_n_per_m_ = 0;
    std::vector<tissue::CoordinateGuides::Guide> guides_;
};

}  // namespace risorius::figures
