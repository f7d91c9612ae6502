// SPDX-License-Identifier: MIT
// One-sided Jacobi rotations. They are accurate also for equal stretches, as in the rest shape.
#include "risorius/tissue/detail/principal_stretches.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "risorius/solve/lanes.h"

namespace risorius::tissue::detail {

namespace {

using solve::Lanes;

/// Four 3 x 3 matrices by columns.
struct LaneMatrix {
    Lanes column[3][3];
};

Lanes dot(const Lanes (&a)[3], const Lanes (&b)[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Lanes absolute(const Lanes& a) { return a < 0 ? -a : a; }

/// Turns two columns by the angle with cosine c and sine s.
void turn(LaneMatrix& m, int p, int q, const Lanes& c, const Lanes& s) {
    for (int i = 0; i < 3; ++i) {
        const Lanes old = m.column[p][i];
        m.column[p][i] = c * old - s * m.column[q][i];
        m.column[q][i] = s * old + c * m.column[q][i];
    }
}

/// Rotates B = F V and V until the columns of B are orthogonal. A lane that is done is turned by 0.
void orthogonalise(LaneMatrix& b, LaneMatrix& v) {
    constexpr int kSweeps = 12;
    constexpr double kOrthogonal = 1e-15;
    const Lanes one = Lanes{} + 1.0;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool turned = false;
        for (int k = 0; k < 3; ++k) {
            const int p = k == 0 ? 1 : 0, q = k == 2 ? 1 : 2;
            const Lanes pp = dot(b.column[p], b.column[p]), qq = dot(b.column[q], b.column[q]);
            const Lanes pq = dot(b.column[p], b.column[q]);
            const auto done = absolute(pq) <= kOrthogonal * solve::sqrt_lanes(pp * qq);
            if (done[0] && done[1] && done[2] && done[3]) continue;
            turned = true;
            const Lanes zeta = (qq - pp) / (2 * (done ? one : pq));
            const Lanes t =
                (zeta < 0 ? -one : one) / (absolute(zeta) + solve::sqrt_lanes(1 + zeta * zeta));
            const Lanes cosine = one / solve::sqrt_lanes(1 + t * t);
            const Lanes c = done ? one : cosine, s = done ? Lanes{} : cosine * t;
            turn(b, p, q, c, s);
            turn(v, p, q, c, s);
        }
        if (!turned) break;
    }
}

// From B = F V with orthogonal columns.
PrincipalStretches from_columns(PrincipalStretches out) {
    Mat3& b = out.u;
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

}  // namespace

std::array<PrincipalStretches, 4> principal_stretches(const std::array<Mat3, 4>& f) {
    LaneMatrix b, v;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            b.column[j][i] = Lanes{f[0](i, j), f[1](i, j), f[2](i, j), f[3](i, j)};
            v.column[j][i] = Lanes{} + (i == j ? 1.0 : 0.0);
        }
    orthogonalise(b, v);
    std::array<PrincipalStretches, 4> out;
    for (int lane = 0; lane < 4; ++lane) {
        PrincipalStretches one;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                one.u(i, j) = b.column[j][i][lane];
                one.v(i, j) = v.column[j][i][lane];
            }
        out[static_cast<std::size_t>(lane)] = from_columns(one);
    }
    return out;
}

PrincipalStretches principal_stretches(const Mat3& f) {
    return principal_stretches(std::array<Mat3, 4>{f, f, f, f})[0];
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
