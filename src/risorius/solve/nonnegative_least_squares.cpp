// SPDX-License-Identifier: MIT
#include "risorius/solve/nonnegative_least_squares.h"

#include <Eigen/Cholesky>

namespace risorius::solve {

namespace {

constexpr int kMaxSteps = 100;
constexpr double kSmallOfResidual = 1e-10;  // of the residual, relative to y

/// The convex function of r whose gradient is r + B max(0, B^T r - cost) / ridge - y.
double merit(const Eigen::VectorXd& r, const Eigen::VectorXd& pull, const Eigen::VectorXd& y,
             double ridge) {
    return 0.5 * r.squaredNorm() + 0.5 / ridge * pull.cwiseMax(0.0).squaredNorm() - y.dot(r);
}

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& B, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& cost, double ridge,
                                          Eigen::VectorXd& residual) {
    Eigen::VectorXd r = residual.size() == y.size() ? residual : y;
    Eigen::VectorXd pull = B.transpose() * r - cost;
    const double small = kSmallOfResidual * std::max(1.0, y.norm());
    for (int step = 0; step < kMaxSteps; ++step) {
        const Eigen::VectorXd gradient = r + B * pull.cwiseMax(0.0) / ridge - y;
        if (gradient.norm() <= small) break;
        Eigen::MatrixXd J = Eigen::MatrixXd::Identity(y.size(), y.size());
        for (long i = 0; i < pull.size(); ++i)
            if (pull[i] > 0) J.selfadjointView<Eigen::Lower>().rankUpdate(B.col(i), 1 / ridge);
        const Eigen::VectorXd down = -J.selfadjointView<Eigen::Lower>().llt().solve(gradient);
        const double before = merit(r, pull, y, ridge), slope = gradient.dot(down);
        double way = 1;
        Eigen::VectorXd next = r + down, next_pull = B.transpose() * next - cost;
        while (way > 1e-6 && merit(next, next_pull, y, ridge) > before + 1e-4 * way * slope) {
            way /= 2;
            next = r + way * down;
            next_pull = B.transpose() * next - cost;
        }
        r = next;
        pull = next_pull;
    }
    residual = r;
    return pull.cwiseMax(0.0) / ridge;
}

}  // namespace risorius::solve
