// SPDX-License-Identifier: MIT
/// \file
/// Energy and gradient of all cells, four at a time. Cells whose law is the same at all Gauss points use the fast method of
/// cell_lanes.h. Cells with moduli and a curved rest shape are summed over their Gauss points.
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"
#include "risorius/tissue/detail/cell_lanes.h"

namespace risorius::tissue::detail {

/// The cells of one body in the form that the inner loops read. An object keeps scratch arrays, so only one thread at a time
/// may use it.
class CellKernel {
  public:
    CellKernel(const CellBody& body, const Points& rest_vertices,
               const Eigen::VectorXd& rest_volume);

    /// Adds dE/dx to `gradient`, n x 3, N. Unless `v` is null, it also subtracts the damping force at the velocities `v`.
    /// Returns E, J.
    double add_gradient(const CellMesh& mesh, const Points& x, const Points* v, Points& gradient);
    /// Adds the derivative of E + h R by x to `gradient`. Returns E + h R, J.
    double add_potential(const CellMesh& mesh, const solve::ImplicitStep& step, const Points& x,
                         Points& gradient);

  private:
    /// Four cells whose law differs from Gauss point to Gauss point.
    struct CurvedGroup {
        Lanes inverse_metric[8][6];  ///< C sqrt(weight of the point), in the scale of Modes
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
    /// kStrains per group; empty when all cells are parallelepipeds.
    std::vector<Lanes> rest_targets_;
    bool damped_ = false;

    // The current implicit step: target strains, and their stiffness lambda + omega / h
    Points step_start_;
    double step_s_ = 0;
    double step_energy_ = 0;  ///< part of the energy that does not depend on x, J
    std::vector<Lanes> step_targets_, step_stiffness_;

    solve::PaddedPoints x_, v_, gradient_;
};

}  // namespace risorius::tissue::detail
