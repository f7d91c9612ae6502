// SPDX-License-Identifier: MIT
/// \file
/// Views of Eigen matrices for CHOLMOD.
#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>

namespace risorius::solve::detail {

/// Returns a view of the lower triangle of an Eigen matrix. Nothing is copied, so the matrix must outlive the view.
inline cholmod_sparse view_of(const Eigen::SparseMatrix<double>& A) {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(A.rows());
    view.nzmax = static_cast<std::size_t>(A.nonZeros());
    view.p = const_cast<int*>(A.outerIndexPtr());
    view.i = const_cast<int*>(A.innerIndexPtr());
    view.x = const_cast<double*>(A.valuePtr());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
}

}  // namespace risorius::solve::detail
