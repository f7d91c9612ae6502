// SPDX-License-Identifier: MIT
/// \file
/// The panels of a Cholesky factor without CHOLMOD's module Supernodal, which is under the GPL: builds whose licence may not be, such as
/// that for browsers, find them from the pattern of the factor.
#pragma once

#include <Eigen/SparseCore>

#include "risorius/solve/detail/nested_dissection.h"

namespace risorius::solve::detail {

/// As panel_pattern(): columns whose patterns nest are a panel, and panels are joined where that stores few zeros. `order` is in
/// post-order of the elimination tree.
PanelPattern simplicial_panels(const Eigen::SparseMatrix<double>& A, std::vector<int> order);

}  // namespace risorius::solve::detail
