// Ordering and symbolic analysis of a sparse symmetric matrix over nodes, by CHOLMOD.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace risorius::solve::detail {

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
