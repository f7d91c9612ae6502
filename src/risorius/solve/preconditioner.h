// SPDX-License-Identifier: MIT
/// \file
/// Approximate inverse of the second derivative of the potential of an implicit step (energy_term.h). A quasi-Newton method
/// uses it as its initial metric.
///
///   H  second derivative of Phi = sum m |x - y|^2 / (2 h^2) + E + h R, 3n x 3n, N/m
#pragma once

#include "risorius/solve/motion_system.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::solve {

/// The interface of all preconditioners.
class Preconditioner {
  public:
    virtual ~Preconditioner() = default;

    /// Prepares for a step. It is called before a step is solved, with the positions x from which the step starts. Constant
    /// preconditioners ignore it.
    virtual void refresh(const ImplicitStep& /*step*/, const Points& /*x*/) {}

    /// x = B b, where B approximates H^-1 and is symmetric and positive definite; n x 3 each. Rows of fixed nodes of b are
    /// zero.
    virtual void apply(const Points& b, Points& x) const = 0;
};

/// Preconditioner for any system: the mass matrix M/h^2 plus the sum of add_metric() of the terms, factored once for steps of
/// length h. It is an n x n matrix with one number per pair of nodes, used for x, y and z alike.
class PrefactoredMetric : public Preconditioner {
  public:
    PrefactoredMetric(const MotionSystem& system, double step_s);

    void apply(const Points& b, Points& x) const override { factor_.solve(b, x); }
    long nonzeros() const { return factor_.nonzeros(); }

  private:
    SparseCholesky factor_;
};

}  // namespace risorius::solve
