// SPDX-License-Identifier: MIT
/// \file
/// Ordering and symbolic analysis of a sparse symmetric matrix over nodes, by CHOLMOD.
#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <vector>

namespace risorius::solve::detail {

/// Calls cholmod_analyze(), by one thread at a time. METIS, which computes the nested dissection, seeds and uses the global
/// rand() of the process. Two orderings at the same time would change each other, and another order of the sums would change
/// the last bits of results.
cholmod_factor* analyse(cholmod_sparse& A, cholmod_common& common);

/// Returns an order of the rows of A with a sparse factor, in post-order of the elimination tree. Groups of `block` consecutive
/// rows belong to one node and stay together. Throws std::invalid_argument when no ordering is found.
std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& A, int block);

/// The panels of the factor of A. A panel consists of consecutive columns with similar patterns.
struct PanelPattern {
    std::vector<int> order;      ///< order[i]: the row of A that becomes row i of the factor
    std::vector<int> super;      ///< first column of each panel, then n
    std::vector<int> row_begin;  ///< index in `row` where each panel begins, then the size of `row`
    std::vector<int> row;        ///< rows of each panel, ascending: its own columns, then others
};
/// `order`: an order of the rows in which groups of rows stay together, as of nested_dissection(). The result is in post-order.
PanelPattern panel_pattern(const Eigen::SparseMatrix<double>& A, const std::vector<int>& order);

}  // namespace risorius::solve::detail
