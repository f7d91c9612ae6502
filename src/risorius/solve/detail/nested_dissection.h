// SPDX-License-Identifier: MIT
/// \file
/// Ordering and symbolic analysis of a sparse symmetric matrix over nodes, by CHOLMOD.
#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <vector>

namespace risorius::solve::detail {

/// cholmod_analyze(), one thread at a time. METIS, which makes the nested dissection, seeds and uses the global rand() of the
/// process. Two simultaneous orderings would differ from either alone, and another order of sums gives other bits.
cholmod_factor* analyse(cholmod_sparse& A, cholmod_common& common);

/// An order of the rows of A that keeps its factor sparse, in post-order. Groups of `block` consecutive rows belong to one node
/// and stay together. Throws std::invalid_argument when no ordering is found.
std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& A, int block);

/// Panels: columns of the factor of A, after nested dissection, that have similar patterns.
struct PanelPattern {
    std::vector<int> order;      ///< row of A at each position
    std::vector<int> super;      ///< first column of each panel, then n
    std::vector<int> row_begin;  ///< where each panel begins in `row`, then the end
    std::vector<int> row;        ///< ascending within each panel; its own columns come first
};
PanelPattern panel_pattern(const Eigen::SparseMatrix<double>& A, int block);

}  // namespace risorius::solve::detail
