// SPDX-License-Identifier: MIT
/// \file
/// The energies of a face as one list of terms. Each sum over the face's energies (energy and gradient, second derivative,
/// metric, start of a step) runs over this list; FaceTissue::build_terms() is the one place that fills it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"
#include "risorius/solve/lanes.h"

namespace risorius::face {

/// What a term of the face may depend on besides the node positions. FaceTissue updates it before it evaluates the terms.
struct TermInputs {
    const Eigen::VectorXd* activation = nullptr;             ///< per column, 0..1
    solve::Precision precision = solve::Precision::kDouble;  ///< of steps of motion
    bool solids_relaxed = false;                             ///< volume muscles exert nothing
};

/// Fraction of its contact stiffness that the metric of steps of motion gives every node that may ever touch. Few nodes touch at
/// a time, and along one direction only. Half of it doubles the error of the same iterations; a thirtieth overshoots.
inline constexpr double kContactFraction = 0.1;

struct FaceTerm {
    std::shared_ptr<solve::EnergyTerm> term;
    /// The pairs of nodes change from step to step. Such terms are added last to matrices, whose pattern stays the longer.
    bool changing_pairs = false;
    /// LocalSolve has a form of the term for the few nodes it moves; it evaluates others over all nodes.
    bool local_form = false;
};

using FaceTerms = std::vector<FaceTerm>;

/// Partial sums, J: the first term and all others. Adding them in another order would change the last bit.
struct TermEnergy {
    double first = 0, others = 0;

    double sum() const { return first + others; }
};

/// Adds the gradient of all terms to `gradient`, n x 3, N.
TermEnergy add_potential(const FaceTerms& terms, const solve::ImplicitStep& step, const Points& x,
                         Points& gradient);
void add_hessian(const FaceTerms& terms, const solve::ImplicitStep& step, const Points& x,
                 solve::Curvature curvature, solve::HessianBuilder& hessian);
void add_metric(const FaceTerms& terms, double step_s, solve::MetricBuilder& metric);

}  // namespace risorius::face
