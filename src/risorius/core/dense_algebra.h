// SPDX-License-Identifier: MIT
/// \file
/// Decompositions of dense matrices of any size, compiled here once: wherever Eigen's own are named they take seconds to compile.
#pragma once

#include <complex>
#include <vector>

#include "risorius/core/types.h"

namespace risorius {

/// Of a symmetric matrix, of which the lower triangle is read.
struct SymmetricEigen {
    Eigen::VectorXd values;   ///< ascending
    Eigen::MatrixXd vectors;  ///< of unit length, one per column
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// The nearest symmetric matrix without negative eigenvalues; the lower triangle is read.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& matrix);

/// Of any square matrix.
std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix);

/// X of matrix X = right, one solution per column; complete pivoting, for matrices near singular.
Eigen::MatrixXd solved_for(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// x of matrix x = right, of a symmetric matrix that may be singular.
Eigen::VectorXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace risorius
