// SPDX-License-Identifier: MIT
/// \file
/// The energies of a face as one list of terms. Each sum over the energies of the face (energy and gradient, second
/// derivative, metric, force on the mandible) runs over this list. FaceTissue::build_terms() is the one place that fills
/// it.
///
/// A force that acts between nodes of the tissue is a solve::EnergyTerm. A force that bone, lids, air or gravity take part
/// in is a FaceTerm; its file is in terms/.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/face/solver/detail/boundary_state.h"
#include "risorius/face/solver/detail/local_term.h"
#include "risorius/solve/energy_term.h"
#include "risorius/solve/lanes.h"

namespace risorius::face {

/// Steps at least this long, s, seek an equilibrium instead of following a motion.
inline constexpr double kSettling_s = 0.1;

/// Fraction of its contact stiffness that the metric of time steps gives every node that may ever touch. Few nodes touch at
/// a time, and along one direction only. Half of it doubles the error of the same iterations; a thirtieth overshoots.
inline constexpr double kContactFraction = 0.1;

/// What a term of the face may depend on besides the node positions. FaceTissue updates it before it evaluates the terms.
struct TermInputs {
    const Eigen::VectorXd* activation = nullptr;             ///< per column, 0..1
    solve::Precision precision = solve::Precision::kDouble;  ///< of time steps
    bool solids_relaxed = false;                             ///< volume muscles exert nothing
};

/// Returns whether the step stands for an equilibrium: its length is infinite.
bool in_equilibrium(const solve::ImplicitStep& step);

/// An energy term that depends on the boundary conditions. Terms refer to objects of FaceTissue.
class FaceTerm : public solve::EnergyTerm {
  public:
    /// Places targets, directions and loads for the boundary conditions.
    virtual void set_boundary_conditions(const BoundaryState& /*boundary*/) {}

    /// Moves the mandible within a step, `mandible` from rest: targets follow, directions stay those of the start of the
    /// step.
    virtual void move_mandible(const Rigid& /*mandible*/) {}

    /// Moves the nodes x, n x 3, m, that follow the mandible, when it moves from `from` to `to`.
    virtual void carry(Points& /*x*/, const Rigid& /*from*/, const Rigid& /*to*/) const {}

    /// Adds dE/d(motion of the mandible) at x: of the bone ends of the term, and of the nodes that carry() moves.
    /// `gradient` is that of all terms by the nodes, n x 3, N. The last evaluation of the energy was at x.
    virtual void add_mandible_gradient(const Rigid& /*mandible*/, const Points& /*x*/,
                                       const Points& /*gradient*/, Wrench& /*sum*/) const {}

    /// Returns the term for the nodes of a LocalSolve, and adds the held nodes it needs. A term without such a form returns
    /// nothing; LocalSolve then evaluates it over all nodes.
    virtual std::unique_ptr<LocalTerm> restricted_to(LocalNodes& /*nodes*/) const { return {}; }
};

/// Where a term stands in sums whose order is not that of the list. Another order would change the last bit of results.
struct TermOrder {
    /// The pairs of nodes change from step to step. Such terms are added last to matrices, whose pattern stays the longer.
    bool changing_pairs = false;
    /// The term is added last to the force on the mandible.
    bool last_on_mandible = false;
};

class FaceTerms {
  public:
    struct Entry {
        std::shared_ptr<solve::EnergyTerm> term;
        FaceTerm* face_term = nullptr;  ///< the same object, or nothing when it is no FaceTerm
        TermOrder order;
    };
    /// Partial sums, J: the first term and all others. Adding them in another order would change the last bit.
    struct Energy {
        double first = 0, others = 0;

        double sum() const { return first + others; }
    };

    /// Adds a term after all others.
    void add(std::shared_ptr<solve::EnergyTerm> term, TermOrder order = {});

    void set_boundary_conditions(const BoundaryState& boundary);
    void move_mandible(const Rigid& mandible);
    void carry(Points& x, const Rigid& from, const Rigid& to) const;
    Wrench mandible_gradient(const Rigid& mandible, const Points& x, const Points& gradient) const;

    void begin_step(double step_s, const Points& start);
    /// Adds the gradient of all terms to `gradient`, n x 3, N. Needs two terms at least.
    Energy add_potential(const solve::ImplicitStep& step, const Points& x, Points& gradient) const;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;
    void add_metric(double step_s, solve::MetricBuilder& metric) const;

    const std::vector<Entry>& list() const { return list_; }
    /// Indices into list() in the order in which terms are added to matrices.
    std::vector<std::size_t> order_of_matrices() const;

  private:
    std::vector<Entry> list_;
};

}  // namespace risorius::face
