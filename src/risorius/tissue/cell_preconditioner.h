// SPDX-License-Identifier: MIT
/// \file
/// Preconditioner of an implicit step of a nearly incompressible solid of cells, in O(n): what keeps volume is eliminated
/// exactly, by one pressure per cell; the rest is little more than each node's own stiffness.
///
///   H = A + C^T D C     A   M/h^2, shape and the other terms     d  its diagonal, one number per node
///                       C   volume gradients of cells now        D  stiffness of volumes, d2E/dV2
///   B = (d + C^T D C)^-1 = d^-1 - d^-1 C^T S^-1 C d^-1,   S = D^-1 + C d^-1 C^T        (Sherman, Morrison & Woodbury)
///
/// Why: tissue is 20 to 1000 times stiffer in volume than in shape. Motions that keep volume involve whole neighbourhoods of
/// nodes, so that smoothing H node by node fails, and the more the stiffer volume is; S acts like Poisson's equation, which
/// multigrid is best at, and has one unknown per cell. Braess & Sarazin 1997, Appl. Numer. Math. 23.
///
/// It is as good as d is near A: the condition number of B H grows with the stiffness of shape between neighbours over M/h^2,
/// that is with resolution squared, and iterations with its root.
#pragma once

#include <memory>

#include "risorius/solve/preconditioner.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::tissue {

struct CellPreconditionerOptions {
    int degree = 12;          ///< of the smoothing polynomials, before and after   [1, ...)
    int coarsest_cells = 64;  ///< so few are solved directly
};

class CellPreconditioner : public solve::Preconditioner {
  public:
    /// `solid` is a term of `system`, whose nodes are the solid's. Steps are of `step_s`. Throws std::invalid_argument
    /// unless the cells are a uniform grid.
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
