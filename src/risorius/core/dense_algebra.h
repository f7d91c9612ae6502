// SPDX-License-Identifier: MIT
/// \file
/// Decompositions of dense matrices of any size. They are compiled only once, because each file that uses the decompositions of
/// Eigen takes seconds longer to compile.
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

/// Solves matrix X = right for X, one solution per column. It uses complete pivoting, for nearly singular matrices.
Eigen::MatrixXd solved_for(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);
/// The inverse of a matrix that is not singular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// The inverse of a symmetric matrix with positive eigenvalues. Only the lower triangle is read.
Eigen::MatrixXd inverse_of_positive(const Eigen::MatrixXd& matrix);
/// Solves matrix x = right for x. The matrix is symmetric and may be singular.
Eigen::VectorXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
/// The same for several right sides, one solution per column.
Eigen::MatrixXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

}  // namespace risorius
