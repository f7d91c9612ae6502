// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/smooth_field.h"

#include <cmath>

#include "risorius/core/dense_algebra.h"

namespace risorius::landmarks {

namespace {

// How faces differ from one another after a similarity: over most of a face, and within a lip or a nostril
constexpr double kWide_m = 0.080, kWideDeviation_m = 0.010, kNarrow_m = 0.025,
                 kNarrowDeviation_m = 0.003;

double matern(double r, double length, double deviation) {
    const double scaled = std::sqrt(3.0) * r / length;
    return deviation * deviation * (1 + scaled) * std::exp(-scaled);
}

double covariance(double r) {
    return matern(r, kWide_m, kWideDeviation_m) + matern(r, kNarrow_m, kNarrowDeviation_m);
}

}  // namespace

SmoothField::SmoothField(const Points& x, const std::vector<double>& s)
    : x_(x), s_(s), weights_(Points::Zero(x.rows(), 3)) {
    const Eigen::Index n = x.rows();
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j)
            matrix(i, j) = matrix(j, i) = covariance((x.row(i) - x.row(j)).norm());
        const double own = s[static_cast<std::size_t>(i)];
        matrix(i, i) += own * own;
    }
    inverse_ = inverse_of_positive(matrix);
}

void SmoothField::set(const Points& d) {
    d_ = d;
    weights_ = inverse_ * d;
}

Vec3 SmoothField::at_point(Eigen::Index i) const {
    const double own = s_[static_cast<std::size_t>(i)];
    return (d_.row(i) - own * own * weights_.row(i)).transpose();
}

Vec3 SmoothField::at(const Vec3& p) const {
    Vec3 out = Vec3::Zero();
    for (Eigen::Index i = 0; i < x_.rows(); ++i)
        out += covariance((x_.row(i).transpose() - p).norm()) * weights_.row(i).transpose();
    return out;
}

double SmoothField::deviation_at(const Vec3& p) const {
    Eigen::VectorXd near(x_.rows());
    for (Eigen::Index i = 0; i < x_.rows(); ++i)
        near[i] = covariance((x_.row(i).transpose() - p).norm());
    return std::sqrt(std::max(0.0, covariance(0) - near.dot(inverse_ * near)));
}

}  // namespace risorius::landmarks
