// SPDX-License-Identifier: MIT
/// \file
/// Extra iterations of a step that are restricted to some nodes of the tissue, all others being held. Nodes that converge
/// slowly get more iterations at the cost of these nodes alone.
///
/// The energy is that of the whole step (face_tissue.h) without what no moving node takes part in. Each term gives its form
/// for these nodes (FaceTerm::restricted_to).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/face/solver/detail/local_term.h"
#include "risorius/solve/quasi_newton.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::face {

class LocalSolve {
  public:
    /// `moves` has one flag per node of the tissue, `rest` (m) and `mass_kg` one row per node. `h` is the length of the
    /// steps, s. Keeps references to the objects of the terms. Make a new LocalSolve when the list of terms or their
    /// stiffness changes.
    LocalSolve(const FaceTerms& terms, const std::vector<char>& moves, const Points& rest,
               const Eigen::VectorXd& mass_kg, double h);

    double step_s() const { return h_; }
    int moving_nodes() const { return nodes_.moving(); }

    /// Continues a step at x, n x 3, m, and moves x.
    solve::StepReport advance(const LocalStep& step, const solve::QuasiNewtonOptions& options,
                              Points& x);

    /// Starts the iterations of a step at x.
    void begin(const LocalStep& step, const Points& x);
    /// Returns the energy of the step, J, but for a constant, and its gradient over local nodes: zero on held ones. After
    /// begin().
    double energy(const Points& at, Points& gradient) const;
    Points taken(const Points& x) const { return nodes_.taken(x); }  ///< the local rows of x
    const std::vector<int>& nodes() const { return nodes_.nodes(); }

  private:
    /// Terms without a local form are evaluated over all nodes, with the others held.
    void add_whole_metric(const solve::EnergyTerm& term, solve::MetricBuilder& builder) const;
    double add_whole_potential(const Points& at, Points& gradient) const;

    double h_;
    LocalNodes nodes_;
    std::vector<std::unique_ptr<LocalTerm>> terms_;  // one per term of the face, or nothing
    std::vector<const solve::EnergyTerm*> whole_terms_;
    Eigen::VectorXd mass_kg_;
    std::optional<solve::SparseCholesky> metric_;
    solve::QuasiNewton newton_;
    Points aim_, x_;
    Points whole_start_;
    mutable Points whole_x_, whole_gradient_;
};

}  // namespace risorius::face
