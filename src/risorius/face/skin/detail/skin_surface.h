// SPDX-License-Identifier: MIT
/// \file
/// The skin at the resolution of the mesh: a membrane with bending stiffness on an elastic bed of fat and ligaments, which the tissue moves.
///
///   p   where the tissue carries a vertex      X   rest      K   stiffness of the bed per area, Pa/m      A   area
///
///   E(x) = sum K A/2 |x - p|^2 + membrane and bending of tissue/skin_sheet.h about the rest shape of the mesh
///
/// The skin evens out the motion of the coarse tissue over lengths below (B/K)^(1/4), about 2 mm (B: bending stiffness). E does not change
/// when the face rotates, so features of the rest shape are kept. The minimisation starts at x = p and takes a fixed number of steps with
/// one prefactored matrix; at p = X it does not move.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/tissue/skin_sheet.h"

namespace risorius::face {

struct SkinSheetOnBed {
    Triangles triangles;               ///< over the rows of `rest`
    Points rest;                       ///< V x 3, m
    std::vector<double> bed_pa_per_m;  ///< V, > 0
    std::vector<char> held;            ///< V, follows the tissue exactly
    double membrane_n_per_m = 10;
    double bending_n_m = 2e-5;
};

class SkinSurface {
  public:
    /// Vertices on the border of the triangles are held too. Triangles without area are left out.
    explicit SkinSurface(const SkinSheetOnBed& sheet);

    /// Converts the positions of the vertices on the tissue, p, to those of the skin, V x 3, m. One thread at a time.
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
