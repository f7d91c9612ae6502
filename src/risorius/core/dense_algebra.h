// SPDX-License-Identifier: MIT
/// \file
/// Decompositions of dense matrices of any size. They are compiled once, here, because every file that uses those of Eigen
/// takes seconds longer to compile.
#pragma once

#include <complex>
#include <vector>

#include "risorius/core/types.h"

namespace risorius {

/// Eigen-decomposition of a symmetric matrix. Only the lower triangle is read.
struct SymmetricEigen {
    Eigen::VectorXd values;   ///< ascending
    Eigen::MatrixXd vectors;  ///< unit length, one per column
};
/// Eigenvalues and eigenvectors of a symmetric matrix.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// Eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// The nearest symmetric matrix without negative eigenvalues. Only the lower triangle is read.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& matrix);

/// Eigenvalues of any square matrix.
std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix);

/// X of matrix X = right, one solution per column. Uses complete pivoting, for nearly singular matrices.
Eigen::MatrixXd solved_for(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);
/// The inverse of a regular matrix.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// x of matrix x = right. The matrix is symmetric and may be singular.
Eigen::VectorXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace risorius
