// SPDX-License-Identifier: MIT
#include "risorius/geom/fitted_sphere.h"

#include <Eigen/LU>
#include <cmath>

namespace risorius::geom {

Sphere fitted_sphere(const std::vector<Vec3>& points) {
    const auto count = static_cast<double>(points.size());
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p;
    mean /= count;

    // With d = p - mean: sum d d^T (c - mean) = 1/2 sum d |d|^2, and r^2 = |c - mean|^2 + mean of |d|^2.
    Mat3 spread = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    double squares = 0;
    for (const Vec3& p : points) {
        const Vec3 d = p - mean;
        spread += d * d.transpose();
        right += 0.5 * d.squaredNorm() * d;
        squares += d.squaredNorm();
    }
    const Vec3 off = spread.inverse() * right;
    return {mean + off, std::sqrt(off.squaredNorm() + squares / count)};
}

}  // namespace risorius::geom
