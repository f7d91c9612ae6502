// SPDX-License-Identifier: MIT
#include "risorius/core/rotations.h"

#include <Eigen/SVD>
#include <cmath>

namespace risorius {

namespace {

constexpr double kNearOpposite = -1 + 1e-12;

}  // namespace

Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to) {
    const Vec3 start = from.normalized(), end = to.normalized();
    const double cosine = end.dot(start);
    if (cosine < kNearOpposite) {
        const Vec3 axis = start.unitOrthogonal();
        return {0, axis.x(), axis.y(), axis.z()};
    }
    const double s = std::sqrt((1 + cosine) * 2);
    Eigen::Quaterniond turn;
    turn.vec() = start.cross(end) * (1 / s);
    turn.w() = s * 0.5;
    return turn;
}

NearestRotation nearest_rotation(const Mat3& matrix) {
    const Eigen::JacobiSVD<Mat3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Vec3 signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
    return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(),
            svd.singularValues().cwiseProduct(signs)};
}

Rigid nearest_motion(const Points& from, const Points& to) {
    return Rigid(Eigen::umeyama(from.transpose(), to.transpose(), false));
}

}  // namespace risorius
