// SPDX-License-Identifier: MIT
// Hestenes & Stiefel's iteration with a block Jacobi preconditioner.
#include "risorius/solve/detail/conjugate_gradients.h"

#include <cassert>
#include <cmath>

#include "risorius/solve/point_sums.h"

namespace risorius::solve {

void multiply(const SymmetricBlocks& A, const Points& x, Points& y) {
    y.setZero(x.rows(), 3);
    const double* const from = x.data();
    double* const to = y.data();
    for (int j = 0; j < A.nodes(); ++j) {
        const int first = A.begin[static_cast<std::size_t>(j)];
        const int last = A.begin[static_cast<std::size_t>(j) + 1];
        const double x0 = from[3 * j], x1 = from[3 * j + 1], x2 = from[3 * j + 2];
        // The diagonal block is stored in full.
        const double* d = A.value[static_cast<std::size_t>(first)].data();
        double y0 = d[0] * x0 + d[3] * x1 + d[6] * x2;
        double y1 = d[1] * x0 + d[4] * x1 + d[7] * x2;
        double y2 = d[2] * x0 + d[5] * x1 + d[8] * x2;
        for (int k = first + 1; k < last; ++k) {
            const double* b = A.value[static_cast<std::size_t>(k)].data();
            const int i = A.row[static_cast<std::size_t>(k)];
            double* yi = to + 3 * i;
            const double* xi = from + 3 * i;
            yi[0] += b[0] * x0 + b[3] * x1 + b[6] * x2;
            yi[1] += b[1] * x0 + b[4] * x1 + b[7] * x2;
            yi[2] += b[2] * x0 + b[5] * x1 + b[8] * x2;
            y0 += b[0] * xi[0] + b[1] * xi[1] + b[2] * xi[2];
            y1 += b[3] * xi[0] + b[4] * xi[1] + b[5] * xi[2];
            y2 += b[6] * xi[0] + b[7] * xi[1] + b[8] * xi[2];
        }
        to[3 * j] += y0;
        to[3 * j + 1] += y1;
        to[3 * j + 2] += y2;
    }
}

ConjugateGradientReport ConjugateGradients::solve(const SymmetricBlocks& A, const Points& b,
                                                  double tolerance, int iterations, Points& x) {
    const int n = A.nodes();
    assert(b.rows() == n);
    inverse_.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const Mat3& block = A.value[static_cast<std::size_t>(A.begin[static_cast<std::size_t>(i)])];
        Mat3& inverse = inverse_[static_cast<std::size_t>(i)];
        // A block that is not positive definite shows up later as negative curvature. The preconditioner must be positive
        // definite.
        const bool positive = block(0, 0) > 0 &&
                              block(0, 0) * block(1, 1) - block(1, 0) * block(0, 1) > 0 &&
                              block.determinant() > 0;
        const double scale = block.cwiseAbs().maxCoeff();
        if (positive)
            inverse = block.inverse();
        else
            inverse = Mat3::Identity() * (scale > 0 ? 1 / scale : 1.0);
    }
    const auto precondition = [&](const Points& r, Points& z) {
        z.resize(n, 3);
        for (int i = 0; i < n; ++i) {
            const double* m = inverse_[static_cast<std::size_t>(i)].data();
            const double* p = r.data() + 3 * i;
            double* q = z.data() + 3 * i;
            q[0] = m[0] * p[0] + m[3] * p[1] + m[6] * p[2];
            q[1] = m[1] * p[0] + m[4] * p[1] + m[7] * p[2];
            q[2] = m[2] * p[0] + m[5] * p[1] + m[8] * p[2];
        }
    };

    ConjugateGradientReport report;
    x.setZero(n, 3);
    residual_ = b;
    precondition(residual_, preconditioned_);
    direction_ = preconditioned_;
    double rho = dot(residual_, preconditioned_);
    const double enough = tolerance * tolerance * rho;
    if (rho == 0) {
        report.converged = true;
        return report;
    }
    while (report.iterations < iterations) {
        multiply(A, direction_, product_);
        const double curvature = dot(direction_, product_);
        if (!(curvature > 0)) {
            report.negative_curvature = true;
            return report;
        }
        const double alpha = rho / curvature;
        x += alpha * direction_;
        residual_ -= alpha * product_;
        precondition(residual_, preconditioned_);
        const double next = dot(residual_, preconditioned_);
        ++report.iterations;
        if (next <= enough) {
            report.converged = true;
            return report;
        }
        direction_ = preconditioned_ + (next / rho) * direction_;
        rho = next;
    }
    return report;
}

}  // namespace risorius::solve
