// SPDX-License-Identifier: MIT
/// \file
/// Ordering and symbolic analysis of a sparse symmetric matrix over nodes, by CHOLMOD.
#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <vector>

namespace risorius::solve::detail {

/// cholmod_analyze(), one thread at a time. METIS, which orders by nested dissection, seeds and draws from the process' one
/// rand(): two orderings at once would give others than each alone, and sums in another order other bits.
cholmod_factor* analyse(cholmod_sparse& A, cholmod_common& common);

/// Rows of A in an order that keeps its factor sparse. `block` rows in a row belong to one node and stay together; in
/// post-order. Throws std::invalid_argument when there is none.
std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& A, int block);

/// Panels of columns of like pattern of the factor of A after nested dissection.
struct PanelPattern {
    std::vector<int> order;      ///< row of A at each place
    std::vector<int> super;      ///< first column of each panel, and n
    std::vector<int> row_begin;  ///< of each panel in row, and the end
    std::vector<int> row;        ///< ascending in each panel, its own columns first
};
PanelPattern panel_pattern(const Eigen::SparseMatrix<double>& A, int block);

}  // namespace risorius::solve::detail
