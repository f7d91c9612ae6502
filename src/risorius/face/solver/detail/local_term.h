// SPDX-License-Identifier: MIT
/// \file
/// The form of an energy term of the face that LocalSolve evaluates: over the few nodes that LocalSolve moves and their
/// neighbours.
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
    int moving() const { return moving_; }  ///< number of moving nodes
    /// Returns whether a node of the face is a moving node. Nodes of volume muscles are not.
    bool moves(int node) const {
        return static_cast<std::size_t>(node) < row_.size() && row(node) >= 0 &&
               row(node) < moving_;
    }
    /// Returns the row of a node of the tissue, or -1.
    int row(int node) const { return row_[static_cast<std::size_t>(node)]; }
    /// Returns the row of a node of the tissue and adds it if there is none.
    int add(int node);
    /// Returns, per node of the tissue, its row or -1.
    const std::vector<int>& rows() const { return row_; }
    /// Returns the nodes of the tissue, one per row.
    const std::vector<int>& nodes() const { return node_; }
    /// Returns the rows of x that belong to these nodes, in local order.
    Points taken(const Points& x) const;

  private:
    std::vector<int> row_, node_;
    int moving_ = 0;
};

/// Data of a step of the whole tissue, see face_tissue.h.
struct LocalStep {
    double h;             ///< length of the step, s
    const Points& start;  ///< positions at the start of the step, n x 3, m
    const Points& aim;    ///< positions that nodes would reach without forces, n x 3, m
    const Eigen::VectorXd& activation;  ///< per column, 0..1
    solve::Precision precision;
};

/// An energy term over local nodes. FaceTerm::restricted_to() makes it, and adds the nodes that it needs. LocalSolve then calls
/// the functions below in their order.
class LocalTerm {
  public:
    virtual ~LocalTerm() = default;

    /// Builds the term, when all terms have added their nodes. `rest`: positions at rest, one row per local node, m.
    virtual void build(const LocalNodes& /*nodes*/, const Points& /*rest*/) {}
    /// Adds the metric of the term for steps of length h, over local nodes.
    virtual void add_metric(const LocalNodes& /*nodes*/, double /*h*/,
                            solve::MetricBuilder& /*builder*/) const {}
    /// Starts the iterations of a step. `x`: all nodes of the face, n x 3, m.
    virtual void begin(const LocalNodes& nodes, const LocalStep& step, const Points& x) = 0;
    /// Adds the energy at the local positions `at` (m) to `value`, J, and its gradient to `gradient`, one row per local node, N.
    virtual void add_energy(const Points& at, double& value, Points& gradient) const = 0;
};

}  // namespace risorius::face
