// SPDX-License-Identifier: MIT
/// \file
/// Preconditioner for implicit steps of a nearly incompressible solid of cells. It costs O(n): the volume term is eliminated
/// exactly, with one pressure per cell, and all other terms are reduced to a diagonal.
///
///   H = A + C^T D C     A   inertia M/h^2, stiffness of shape and the other terms     d  diagonal of A, one number per node
///                       C   gradients of the cells' volumes                           D  stiffness of volumes, d2E/dV2
///   B = (d + C^T D C)^-1 = d^-1 - d^-1 C^T S^-1 C d^-1,   S = D^-1 + C d^-1 C^T        (Sherman, Morrison & Woodbury)
///
/// C is taken at the start of the step, and h is the length of the step. Tissue is 20 to 1000 times stiffer in volume than in
/// shape. Motions that keep volume involve whole neighbourhoods of nodes, so a smoother that treats H node by node converges
/// slowly, and the more slowly the stiffer the volume term is. S acts like Poisson's equation, for which multigrid works best,
/// and has one unknown per cell. Source: Braess & Sarazin 1997, Appl. Numer. Math. 23.
///
/// B is a good preconditioner where d is a good approximation of A. The condition number of B H grows with the ratio of shape
/// stiffness between neighbours to M/h^2, that is, with the square of the resolution. The number of iterations grows with the
/// square root of the condition number.
#pragma once

#include <memory>

#include "risorius/solve/preconditioner.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::tissue {

/// Options of the multigrid for the pressures.
struct CellPreconditionerOptions {
    /// Degree of the polynomials that smooth before and after the correction on the coarser grid [1, ...)
    int degree = 12;
    int coarsest_cells = 64;  ///< a grid with at most this many cells is solved directly
};

/// The preconditioner for one system, one solid and one length of step.
class CellPreconditioner : public solve::Preconditioner {
  public:
    /// `solid` is a term of `system`, and the nodes of the system are those of the solid. `step_s` is the length of a step.
    /// Throws std::invalid_argument unless the cells form a uniform grid.
    CellPreconditioner(const solve::MotionSystem& system,
                       const std::shared_ptr<const CellSolid>& solid, double step_s,
                       const CellPreconditionerOptions& options = {});
    ~CellPreconditioner() override;

    void refresh(const solve::ImplicitStep& step, const Points& x) override;
    void apply(const Points& b, Points& x) const override;

    int level_count() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace risorius::tissue
