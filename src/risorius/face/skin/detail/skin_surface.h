// SPDX-License-Identifier: MIT
/// \file
/// The skin at the resolution of the mesh: a membrane with bending stiffness on an elastic bed of fat and ligaments. The tissue moves the bed.
///
///   x   position of a vertex, m      p   position to which the tissue carries it      X   its position at rest
///   K   stiffness of the bed per area, Pa/m         A   area of the vertex, m^2
///
///   E(x) = sum K A/2 |x - p|^2 + membrane and bending of tissue/skin_sheet.h about the rest shape of the mesh
///
/// The skin smooths the motion of the coarse tissue over lengths below (B/K)^(1/4), about 2 mm (B: bending stiffness, N m). E does not change
/// when the face rotates, so features of the rest shape are kept. The minimisation starts at x = p and takes a fixed number of steps with
/// one prefactored matrix; at p = X it does not move.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/tissue/skin_sheet.h"

namespace risorius::face {

/// Mesh and material of the skin and its bed.
struct SkinSheetOnBed {
    Triangles triangles;               ///< over the rows of `rest`
    Points rest;                       ///< V x 3, m
    std::vector<double> bed_pa_per_m;  ///< V, > 0
    std::vector<char> held;            ///< V, flags of vertices that follow the tissue exactly
    double membrane_n_per_m = 10;
    double bending_n_m = 2e-5;
};

/// Computes x from p.
class SkinSurface {
  public:
    /// Vertices on the border of the triangles are held too. Triangles without area are left out.
    explicit SkinSurface(const SkinSheetOnBed& sheet);

    /// Replaces the positions p by the positions x of the skin, V x 3, m. Do not call it from several threads at once.
    void relax(Points& vertices) const;

    int vertices() const { return static_cast<int>(vertex_.size()); }
    long matrix_nonzeros() const { return factor_ ? factor_->nonzeros() : 0; }

  private:
    std::vector<int> vertex_;     ///< of the triangles
    std::vector<char> held_;      ///< per vertex_
    std::vector<double> weight_;  ///< K A per vertex_, N/m
    std::optional<tissue::SkinSheet> sheet_;
    std::optional<solve::SparseCholesky> factor_;
    mutable Points p_, x_, gradient_;
};

}  // namespace risorius::face
