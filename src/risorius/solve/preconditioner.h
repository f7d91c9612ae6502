// SPDX-License-Identifier: MIT
/// \file
/// Approximate inverse of the second derivative of an implicit step's potential: what a quasi-Newton method starts from.
///
///   H  second derivative of Phi = sum m |x - y|^2 / (2 h^2) + E + h R, 3n x 3n, N/m
#pragma once

#include "risorius/solve/motion_system.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::solve {

class Preconditioner {
  public:
    virtual ~Preconditioner() = default;

    /// Called before a step is solved, with the state it is solved from. A constant one ignores it.
    virtual void refresh(const ImplicitStep& /*step*/, const Points& /*x*/) {}

    /// x = B b with B near H^-1, symmetric and positive definite; rows of fixed nodes of b are zero. n x 3 each.
    virtual void apply(const Points& b, Points& x) const = 0;
};

/// The scalar matrix M/h^2 + what the terms' add_metric give, factored once for steps of one length. Works on any system.
class PrefactoredMetric : public Preconditioner {
  public:
    PrefactoredMetric(const MotionSystem& system, double step_s);

    void apply(const Points& b, Points& x) const override { factor_.solve(b, x); }
    long nonzeros() const { return factor_.nonzeros(); }

  private:
    SparseCholesky factor_;
};

}  // namespace risorius::solve
