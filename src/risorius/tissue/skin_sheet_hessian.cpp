// SPDX-License-Identifier: MIT
// The second derivative of SkinSheet.
//
// Triangles are treated in the frame of their principal stretches, like a solid whose third direction carries no load:
// psi_i = k s_i (s_i^2 - 1), and psi_i / s_i across the triangle. A hinge contributes, by its vector l,
//   w (1 - S/s) I + w S / s^3 l l^T
#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/principal_stretches.h"
#include "risorius/tissue/skin_sheet.h"

namespace risorius::tissue {

void SkinSheet::add_hessian(const Points& x, solve::Curvature curvature,
                            solve::HessianBuilder& hessian) const {
    const bool positive = curvature == solve::Curvature::kPositive;
    for (int t = 0; t < triangle_count_; ++t) {
        const TriangleGroup<double>& group = double_.triangles[static_cast<std::size_t>(t / 4)];
        const int lane = t % 4;
        const int node[3] = {node_of(group, 0, lane), node_of(group, 1, lane),
                             node_of(group, 2, lane)};
        const Vec3 e1 = (x.row(node[1]) - x.row(node[0])).transpose();
        const Vec3 e2 = (x.row(node[2]) - x.row(node[0])).transpose();
        Mat3 f;
        f.col(0) = e1 * group.b00[lane];
        f.col(1) = e1 * group.b01[lane] + e2 * group.b11[lane];
        f.col(2).setZero();
        // The frame in the plane rotates only the first two axes, because the third column of F is perpendicular to both.
        const detail::PrincipalStretches stretches = detail::principal_stretches(f);
        const double k = group.stiffness[lane];
        const Vec3& s = stretches.sigma;
        detail::StretchModes modes;
        modes.along.setZero();
        for (int i = 0; i < 2; ++i) {
            modes.along(i, i) = k * (3 * s[i] * s[i] - 1);
            modes.symmetric[1 - i] = modes.antisymmetric[1 - i] = k * (s[i] * s[i] - 1);
        }
        const double squares = s[0] * s[0] + s[1] * s[1] - 1;
        modes.symmetric[2] = k * (squares + s[0] * s[1]);
        modes.antisymmetric[2] = k * (squares - s[0] * s[1]);
        if (positive) {
            modes.along = modes.along.cwiseMax(0.0);
            modes.symmetric = modes.symmetric.cwiseMax(0.0);
            modes.antisymmetric = modes.antisymmetric.cwiseMax(0.0);
        }
        Vec3 gradient[3];
        gradient[1] = stretches.v.transpose() * Vec3(group.b00[lane], group.b01[lane], 0);
        gradient[2] = stretches.v.transpose() * Vec3(0, group.b11[lane], 0);
        gradient[0] = -(gradient[1] + gradient[2]);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b <= a; ++b) {
                const Mat3 block = detail::stretch_block(modes, gradient[a], gradient[b]);
                hessian.add(node[a], node[b], stretches.u * block * stretches.u.transpose());
            }
    }
    for (int h = 0; h < hinge_count_; ++h) {
        const HingeGroup<double>& group = double_.hinges[static_cast<std::size_t>(h / 4)];
        const int lane = h % 4;
        Vec3 l = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            l += group.c[k][lane] *
                 (x.row(node_of(group, k, lane)) - x.row(node_of(group, 3, lane))).transpose();
        const double w = group.w[lane], rest = group.rest_length[lane];
        const double s = std::max(std::sqrt(l.squaredNorm() + group.squared_rounding[lane]),
                                  std::numeric_limits<double>::min());
        double across = w - w * rest / s;
        double along = across + w * rest / s * (l.squaredNorm() / (s * s));
        if (positive) {
            across = std::max(across, 0.0);
            along = std::max(along, 0.0);
        }
        Mat3 block = across * Mat3::Identity();
        if (l.squaredNorm() > 0) block += (along - across) / l.squaredNorm() * (l * l.transpose());
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b)
                hessian.add(node_of(group, a, lane), node_of(group, b, lane),
                            group.c[a][lane] * group.c[b][lane] * block);
    }
}

}  // namespace risorius::tissue
