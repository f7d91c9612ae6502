// SPDX-License-Identifier: MIT
/// \file
/// Multigrid for the pressures of a uniform grid of cells. It solves S q = t, where S is positive definite and acts like
/// Poisson's equation.
///
///   S          matrix over cells, one unknown per cell; neighbours are the 26 cells that have a node in common with a cell
///   coarser    eight cells become one. Plain sums would make pressures constant over eight cells and S twice too stiff;
///              so half of each sum is taken, except for the compliance and the entries that hold the border
///   transfer   trilinear between the centres of cells, the same up and down
///   smoother   Chebyshev polynomials of the fourth kind in D^-1 S, D = diag(S), the same before and after: symmetric, and
///              cells do not wait for their neighbours as in Gauss-Seidel
///
/// Sources: Lottes 2023, Numer. Linear Algebra Appl. 30(6), section 4; Braess 1995, Computing 55, for the factor of two.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "risorius/tissue/detail/padded_grid.h"

namespace risorius::tissue::detail {

/// The solver for the pressures of one grid. An object keeps scratch arrays, so only one thread at a time may use it.
class PressureMultigrid {
  public:
    PressureMultigrid(const GridShape& nodes, int coarsest_cells);

    /// The entries of S without the compliance. The caller fills diagonal() and behind() before refresh().
    Field& diagonal() { return levels_.front().diagonal; }
    Field& behind(int neighbour) {
        return levels_.front().behind[static_cast<std::size_t>(neighbour)];
    }
    /// Adds `compliance` to the diagonal and computes the coarser levels. It is zero where there is no cell.
    void refresh(const Field& compliance);

    /// Computes an approximation q of S^-1 t by one cycle, with smoothing polynomials of degree `degree`. The operator is
    /// symmetric and positive.
    void solve(const Field& t, int degree, Field& q);

    int level_count() const { return static_cast<int>(levels_.size()); }

  private:
    struct Level {
        explicit Level(const GridShape& nodes);
        PaddedGrid grid;
        Field diagonal, compliance,
            inverse;  ///< inverse of diagonal + compliance; 0 where there is no cell
        std::array<Field, 13> behind;  ///< entries of S for the neighbours in kBehind
        float largest = 1;             ///< upper bound of the eigenvalues of D^-1 S
        Field b, x, z, r;
        std::vector<float> along_k, along_jk;  ///< scratch of restrict and prolong
    };
    void coarsen(Level& from, Level& to) const;
    void subtract_product(const Level& level, const Field& x, Field& r) const;
    void smooth(Level& level, int degree, bool residual_after) const;
    void restrict_residual(Level& from, Level& to) const;
    void add_prolonged(Level& to, Level& from) const;
    void cycle(std::size_t level, int degree);

    std::vector<Level> levels_;
    std::vector<int> coarsest_;  ///< cells of the last level
    Eigen::LLT<Eigen::MatrixXf> direct_;
};

}  // namespace risorius::tissue::detail
