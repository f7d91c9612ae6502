// SPDX-License-Identifier: MIT
/// \file
/// Extra iterations of a step that move only some nodes of the tissue. All other nodes are held. So nodes that converge slowly
/// get more iterations, at the cost of these nodes alone.
///
/// The energy is that of the whole step (face_tissue.h), without the parts that do not depend on a moving node. Each term gives
/// its form for these nodes (FaceTerm::restricted_to).
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

/// The solve for one set of moving nodes and one length of step.
class LocalSolve {
  public:
    /// `moves` has one flag per node of the tissue, `rest` (n x 3, m) and `mass_kg` one row per node. `h` is the length of the
    /// steps, s. Keeps references to the objects of the terms. Make a new LocalSolve when the list of terms or their
    /// stiffness changes.
    LocalSolve(const FaceTerms& terms, const std::vector<char>& moves, const Points& rest,
               const Eigen::VectorXd& mass_kg, double h);

    double step_s() const { return h_; }
    /// Returns the number of moving nodes.
    int moving_nodes() const { return nodes_.moving(); }

    /// Makes the extra iterations of a step: starts at x, n x 3, m, and writes the result to the moving rows of x.
    solve::StepReport advance(const LocalStep& step, const solve::QuasiNewtonOptions& options,
                              Points& x);

    /// Starts the iterations of a step at x.
    void begin(const LocalStep& step, const Points& x);
    /// Returns the energy of the step, J, up to a constant, at the local positions `at` (m), and writes its gradient, N, which is
    /// zero on held nodes. Call begin() first.
    double energy(const Points& at, Points& gradient) const;
    Points taken(const Points& x) const { return nodes_.taken(x); }  ///< the local rows of x
    /// Returns the nodes of the tissue, one per local row.
    const std::vector<int>& nodes() const { return nodes_.nodes(); }

  private:
    /// Terms without a local form are evaluated over all nodes, with the others held.
    void add_whole_metric(const solve::EnergyTerm& term, solve::MetricBuilder& builder) const;
    double add_whole_potential(const Points& at, Points& gradient) const;

    double h_;
    LocalNodes nodes_;
    std::vector<std::unique_ptr<LocalTerm>> terms_;  // per term of the face, or null
    std::vector<const solve::EnergyTerm*> whole_terms_;
    Eigen::VectorXd mass_kg_;
    std::optional<solve::SparseCholesky> metric_;
    solve::QuasiNewton newton_;
    Points aim_, x_;
    Points whole_start_;
    mutable Points whole_x_, whole_gradient_;
};

}  // namespace risorius::face
