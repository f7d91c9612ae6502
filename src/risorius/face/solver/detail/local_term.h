// SPDX-License-Identifier: MIT
/// \file
/// The form of an energy term of the face that LocalSolve evaluates: over the few nodes that it moves and those beside
/// them.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::face {

/// Numbers the nodes of a LocalSolve: the moving nodes are its first rows, then come the held nodes that a term needs.
class LocalNodes {
  public:
    /// `moves` has one flag per node of the tissue.
    explicit LocalNodes(const std::vector<char>& moves);

    int count() const { return static_cast<int>(node_.size()); }
    int moving() const { return moving_; }
    /// Takes any node of the face; those of volume muscles never move here.
    bool moves(int node) const {
        return static_cast<std::size_t>(node) < row_.size() && row(node) >= 0 &&
               row(node) < moving_;
    }
    /// Returns the row of a node of the tissue, or -1.
    int row(int node) const { return row_[static_cast<std::size_t>(node)]; }
    /// Returns the row of a node of the tissue and adds it if there is none.
    int add(int node);
    /// One row per node of the tissue, or -1.
    const std::vector<int>& rows() const { return row_; }
    /// The nodes of the tissue, one per row.
    const std::vector<int>& nodes() const { return node_; }
    /// Returns these rows of x.
    Points taken(const Points& x) const;

  private:
    std::vector<int> row_, node_;
    int moving_ = 0;
};

/// A step of the whole tissue, see face_tissue.h.
struct LocalStep {
    double h;             ///< s
    const Points& start;  ///< positions at the start of the step, n x 3, m
    const Points& aim;    ///< positions without forces, n x 3, m
    const Eigen::VectorXd& activation;
    solve::Precision precision;
};

/// A term is made by FaceTerm::restricted_to(), which adds the nodes it needs. The calls below follow in this order.
class LocalTerm {
  public:
    virtual ~LocalTerm() = default;

    /// All terms have added their nodes. `rest` are their positions at rest, one row per local node, m.
    virtual void build(const LocalNodes& /*nodes*/, const Points& /*rest*/) {}
    /// Adds the metric of the term for steps of length h, over local nodes.
    virtual void add_metric(const LocalNodes& /*nodes*/, double /*h*/,
                            solve::MetricBuilder& /*builder*/) const {}
    /// Starts the iterations of a step. x are all nodes of the face, n x 3, m.
    virtual void begin(const LocalNodes& nodes, const LocalStep& step, const Points& x) = 0;
    /// Adds the energy, J, to `value` and its gradient to `gradient`, both over local nodes.
    virtual void add_energy(const Points& at, double& value, Points& gradient) const = 0;
};

}  // namespace risorius::face
