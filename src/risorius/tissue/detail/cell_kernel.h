// SPDX-License-Identifier: MIT
/// \file
/// Energy and gradient of all cells, four at a time: the fast path where the law is constant in a cell (cell_lanes.h), Gauss
/// point by Gauss point where moduli meet a curved rest shape.
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"
#include "risorius/tissue/detail/cell_lanes.h"

namespace risorius::tissue::detail {

class CellKernel {
  public:
    CellKernel(const CellBody& body, const Points& rest_vertices,
               const Eigen::VectorXd& rest_volume);

    /// Adds dE/dx, and the derivative of dissipation at the velocities `v` if given; returns E.
    double add_gradient(const CellMesh& mesh, const Points& x, const Points* v, Points& gradient);
    /// E + h R and its derivative by x.
    double add_potential(const CellMesh& mesh, const solve::ImplicitStep& step, const Points& x,
                         Points& gradient);

  private:
    /// Four cells whose law varies from point to point.
    struct CurvedGroup {
        Lanes inverse_metric[8][6];  ///< C sqrt(share of the point), scaled as the modes are
        Lanes rest[8][6];            ///< t_i . t_j
        Lanes mu, eta;
    };

    void prepare_step(const CellMesh& mesh, const solve::ImplicitStep& step);
    void load(const CellMesh& mesh, const Points& x, solve::PaddedPoints& padded) const;
    void unload(const CellMesh& mesh, Points& gradient);
    template <bool kTargets, bool kRates>
    Lanes add_fast(const Lanes* stiffness, const Lanes* targets);
    template <bool kRates>
    Lanes add_curved(bool damped_step);

    std::vector<CellGroup> groups_;
    std::vector<CurvedGroup> curved_;  ///< empty, or one per group
    std::vector<Lanes>
        rest_targets_;  ///< empty when all cells are parallelepipeds; kStrains per group
    bool damped_ = false;

    // Of the implicit step at hand: what the strains are compared with, weighed by lambda + omega / h
    Points step_start_;
    double step_s_ = 0;
    double step_energy_ = 0;  ///< of the start, which blending leaves out
    std::vector<Lanes> step_targets_, step_stiffness_;

    solve::PaddedPoints x_, v_, gradient_;
};

}  // namespace risorius::tissue::detail
