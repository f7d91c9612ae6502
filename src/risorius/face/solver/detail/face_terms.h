// SPDX-License-Identifier: MIT
/// \file
/// The energies of a face as one list of terms. Each sum over the energies of the face (energy and gradient, second
/// derivative, metric, force on the mandible) runs over this list. Only FaceTissue::build_terms() and FaceTissue::add_term() fill
/// it.
///
/// A force between nodes of the tissue is a solve::EnergyTerm. A force that depends on bone, lids, air or gravity is a FaceTerm;
/// its file is in terms/.
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

/// Steps of at least this length, s, serve to find an equilibrium, not to follow a motion.
inline constexpr double kSettling_s = 0.1;

/// Fraction of the contact stiffness of a node that enters the metric of time steps, for every node that may ever be in contact.
/// Few nodes are in contact at a time, and in one direction only. With a fraction of 0.5, the error after the same number of
/// iterations is twice as large; with 1/30 the iterations overshoot.
inline constexpr double kContactFraction = 0.1;

/// What a term of the face may depend on besides the node positions. FaceTissue updates it before it evaluates the terms.
struct TermInputs {
    const Eigen::VectorXd* activation = nullptr;             ///< per column, 0..1
    solve::Precision precision = solve::Precision::kDouble;  ///< of forces in time steps
    bool solids_relaxed = false;                             ///< volume muscles exert no force
};

/// Returns whether the step stands for an equilibrium: its length is infinite.
bool in_equilibrium(const solve::ImplicitStep& step);

/// An energy term that depends on the boundary conditions. It refers to objects that FaceTissue owns.
class FaceTerm : public solve::EnergyTerm {
  public:
    /// Sets the targets of springs, the directions of supports and the loads as the boundary conditions say.
    virtual void set_boundary_conditions(const BoundaryState& /*boundary*/) {}

    /// Moves the mandible within a step. `mandible` is its motion from rest. Targets follow; directions stay those of the start of
    /// the step.
    virtual void move_mandible(const Rigid& /*mandible*/) {}

    /// Moves the nodes x, n x 3, m, that follow the mandible, when its motion from rest changes from `from` to `to`.
    virtual void carry(Points& /*x*/, const Rigid& /*from*/, const Rigid& /*to*/) const {}

    /// Adds dE/d(motion of the mandible) at x to `sum`: that of the bone ends of the term, and that of the nodes that carry()
    /// moves. `gradient` is the gradient of the sum of all terms by the nodes, n x 3, N. The last evaluation of the energy must
    /// have been at x.
    virtual void add_mandible_gradient(const Rigid& /*mandible*/, const Points& /*x*/,
                                       const Points& /*gradient*/, Wrench& /*sum*/) const {}

    /// Returns the term for the nodes of a LocalSolve, and adds the held nodes that it needs to `nodes`. A term without such a form
    /// returns null; LocalSolve then evaluates it over all nodes.
    virtual std::unique_ptr<LocalTerm> restricted_to(LocalNodes& /*nodes*/) const { return {}; }
};

/// Where a term stands in sums whose order is not that of the list. Another order would change the last bit of results.
struct TermOrder {
    /// The pairs of nodes of the term change from step to step. Such a term is added to matrices last, so that the pattern of the
    /// matrices changes less often.
    bool changing_pairs = false;
    /// The term is added last to the force on the mandible.
    bool last_on_mandible = false;
};

/// The list of the terms, and sums over it. The functions that are not described are those of the terms, for all terms.
class FaceTerms {
  public:
    struct Entry {
        std::shared_ptr<solve::EnergyTerm> term;
        FaceTerm* face_term = nullptr;  ///< the same object, or null if it is not a FaceTerm
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
    /// Returns the energy of all terms, and adds their gradient to `gradient`, n x 3, N. There must be two terms at least.
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
