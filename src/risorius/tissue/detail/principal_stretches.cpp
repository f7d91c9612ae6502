// SPDX-License-Identifier: MIT
// One-sided Jacobi rotations. They are accurate also for equal stretches, as in the rest shape.
#include "risorius/tissue/detail/principal_stretches.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace risorius::tissue::detail {

PrincipalStretches principal_stretches(const Mat3& f) {
    constexpr int kSweeps = 12;
    constexpr double kOrthogonal = 1e-15;
    PrincipalStretches out{f, Mat3::Identity(), Vec3::Zero()};
    Mat3& b = out.u;  // F V, until its columns are orthogonal
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool turned = false;
        for (int k = 0; k < 3; ++k) {
            const int p = k == 0 ? 1 : 0, q = k == 2 ? 1 : 2;
            const double pp = b.col(p).squaredNorm(), qq = b.col(q).squaredNorm();
            const double pq = b.col(p).dot(b.col(q));
            if (std::abs(pq) <= kOrthogonal * std::sqrt(pp * qq)) continue;
            turned = true;
            const double zeta = (qq - pp) / (2 * pq);
            const double t =
                (zeta < 0 ? -1.0 : 1.0) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
            const double c = 1 / std::sqrt(1 + t * t), s = c * t;
            for (Mat3* m : {&b, &out.v}) {
                const Vec3 old = m->col(p);
                m->col(p) = c * old - s * m->col(q);
                m->col(q) = s * old + c * m->col(q);
            }
        }
        if (!turned) break;
    }

    // The direction of the smallest column comes from the other two, so that U is a rotation and its stretch has the sign.
    const Vec3 length(b.col(0).norm(), b.col(1).norm(), b.col(2).norm());
    int min = 0, max = 0;
    for (int k = 1; k < 3; ++k) {
        if (length[k] < length[min]) min = k;
        if (length[k] > length[max]) max = k;
    }
    if (min == max) min = (max + 2) % 3;
    const int middle = 3 - min - max;
    const Vec3 thin = b.col(min);
    out.sigma = length;
    const Vec3 first = length[max] > 0 ? Vec3(b.col(max) / length[max]) : Vec3::Unit(max);
    Vec3 second;
    if (length[middle] > 1e-12 * length[max])
        second = b.col(middle) / length[middle];
    else  // crushed to a line: any perpendicular direction
        second = first.unitOrthogonal();
    b.col(max) = first;
    b.col(middle) = second;
    b.col(min) = b.col((min + 1) % 3).cross(b.col((min + 2) % 3));
    out.sigma[min] = thin.dot(b.col(min));
    return out;
}

void clamp(StretchModes& modes) {
    modes.symmetric = modes.symmetric.cwiseMax(0.0);
    modes.antisymmetric = modes.antisymmetric.cwiseMax(0.0);
    const Mat3& a = modes.along;
    // By Sylvester's criterion there is usually nothing to remove.
    if (a(0, 0) > 0 && a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1) > 0 && a.determinant() > 0) return;
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(a);
    modes.along = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                  eigen.eigenvectors().transpose();
}

Mat3 stretch_block(const StretchModes& modes, const Vec3& a, const Vec3& b) {
    Mat3 block;
    for (int i = 0; i < 3; ++i) block(i, i) = modes.along(i, i) * a[i] * b[i];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double even = 0.5 * (modes.symmetric[k] + modes.antisymmetric[k]);
        const double odd = 0.5 * (modes.symmetric[k] - modes.antisymmetric[k]);
        block(i, i) += even * a[j] * b[j];
        block(j, j) += even * a[i] * b[i];
        block(i, j) = modes.along(i, j) * a[i] * b[j] + odd * a[j] * b[i];
        block(j, i) = modes.along(i, j) * a[j] * b[i] + odd * a[i] * b[j];
    }
    return block;
}

}  // namespace risorius::tissue::detail
