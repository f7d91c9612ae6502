// SPDX-License-Identifier: MIT
#include "risorius/rig/landmark_warp.h"

#include "risorius/core/dense_algebra.h"

namespace risorius::rig {

LandmarkWarp::LandmarkWarp(const Points& from, const Points& to, double smoothing) : from_(from) {
    const long n = from.rows();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 4, 3);
    for (long i = 0; i < n; ++i) {
        for (long j = 0; j < n; ++j) system(i, j) = -(from.row(i) - from.row(j)).norm();
        system(i, i) += smoothing;
        system(i, n) = system(n, i) = 1.0;
        for (int k = 0; k < 3; ++k) system(i, n + 1 + k) = system(n + 1 + k, i) = from(i, k);
        right.row(i) = to.row(i);
    }
    weights_ = solved_for(system, right);
}

Vec3 LandmarkWarp::operator()(const Vec3& p) const {
    const long n = from_.rows();
    Vec3 out = weights_.row(n).transpose();
    for (int k = 0; k < 3; ++k) out += p[k] * weights_.row(n + 1 + k).transpose();
    for (long i = 0; i < n; ++i)
        out -= (p - from_.row(i).transpose()).norm() * weights_.row(i).transpose();
    return out;
}

}  // namespace risorius::rig
