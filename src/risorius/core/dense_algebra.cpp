// SPDX-License-Identifier: MIT
#include "risorius/core/dense_algebra.h"

#include <Eigen/Dense>

namespace risorius {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(matrix);
    return {parts.eigenvalues(), parts.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
        .eigenvalues();
}

Eigen::MatrixXd positive_part(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(matrix);
    return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0.0).asDiagonal() *
           parts.eigenvectors().transpose();
}

std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix) {
    const Eigen::VectorXcd values =
        Eigen::EigenSolver<Eigen::MatrixXd>(matrix, /*computeEigenvectors=*/false).eigenvalues();
    return {values.begin(), values.end()};
}

Eigen::MatrixXd solved_for(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    return matrix.fullPivLu().solve(right);
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) { return matrix.fullPivLu().inverse(); }

Eigen::MatrixXd inverse_of_positive(const Eigen::MatrixXd& matrix) {
    return matrix.llt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

Eigen::VectorXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
    return matrix.ldlt().solve(right);
}

Eigen::MatrixXd solved_symmetric(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    return matrix.ldlt().solve(right);
}

}  // namespace risorius
