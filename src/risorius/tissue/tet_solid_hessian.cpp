// SPDX-License-Identifier: MIT
// The second derivative of TetSolid. The part of each tet, in the frame of its principal stretches, is that of
//   psi_i = mu s_i (s_i^2 - 1) + p s_j s_k,   p = K ((1 - s) (M - 1) + s (J - 1) + c min(0, J - J_c)),
// where M is held. M, the mean J of a fan, changes with all its nodes: this adds (1 - s) K_fan (dM/dx) (dM/dx)^T, which is never
// negative.
#include <algorithm>
#include <array>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/principal_stretches.h"
#include "risorius/tissue/tet_solid.h"

namespace risorius::tissue {

namespace {

detail::StretchModes modes_of(const Vec3& s, double mean_minus_1, double mu, double at_rest) {
    constexpr double kOwn = TetSolid::kOwnVolume;
    const double volume = s[0] * s[1] * s[2];
    const double crushed = std::min(0.0, volume - TetSolid::kCrushed);
    const double pressure =
        at_rest * ((1 - kOwn) * mean_minus_1 + kOwn * (volume - 1) + TetSolid::kHardens * crushed);
    const double bulk = at_rest * (kOwn + (crushed < 0 ? TetSolid::kHardens : 0.0));
    detail::StretchModes modes;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double across = s[i] * s[j];
        modes.along(k, k) = mu * (3 * s[k] * s[k] - 1) + bulk * across * across;
        modes.along(i, j) = modes.along(j, i) = bulk * across * s[k] * s[k] + pressure * s[k];
        const double squares = s[i] * s[i] + s[j] * s[j] - 1;
        modes.symmetric[k] = mu * (squares + across) - pressure * s[k];
        modes.antisymmetric[k] = mu * (squares - across) + pressure * s[k];
    }
    return modes;
}

}  // namespace

void TetSolid::add_hessian(const Points& x, solve::Curvature curvature,
                           solve::HessianBuilder& hessian) const {
    Points of_mean = Points::Zero(static_cast<long>(fans_.size()) * (kFanTets + 3), 3);  // dM/dx
    std::array<Mat3, 4> f;
    std::array<detail::PrincipalStretches, 4> four;
    for (int tet = 0; tet < size(); ++tet) {
        const Mat3& inverse = inverse_[static_cast<std::size_t>(tet)];
        const auto lane = static_cast<std::size_t>(tet % 4);
        if (lane == 0) {
            for (int k = 0; k < 4; ++k)
                f[static_cast<std::size_t>(k)] =
                    deformation_gradient(x, std::min(tet + k, size() - 1));
            four = detail::principal_stretches(f);
        }
        const detail::PrincipalStretches& stretches = four[lane];
        const Vec3& s = stretches.sigma;
        const double bulk = rest_volume_[tet] * bulk_[tet];
        detail::StretchModes modes =
            modes_of(s, mean_volume_ratio(x, tet) - 1, rest_volume_[tet] * mu_[tet], bulk);
        if (curvature == solve::Curvature::kPositive) detail::clamp(modes);

        // Row k of the inverse is the gradient of the shape function of corner k + 1. The four gradients add up to zero.
        const Mat3 g = inverse * stretches.v;
        Vec3 gradient[4];
        for (int k = 0; k < 3; ++k) gradient[k + 1] = g.row(k).transpose();
        gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);

        const auto& in_fan = place_[static_cast<std::size_t>(tet)];
        const Vec3 across(s[1] * s[2], s[2] * s[0], s[0] * s[1]);  // cofactor, in this frame
        for (int a = 0; a < 4; ++a)
            of_mean.row(in_fan.corner[a]) +=
                in_fan.share * (stretches.u * across.cwiseProduct(gradient[a])).transpose();

        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b) {
                const Mat3 block = detail::stretch_block(modes, gradient[a], gradient[b]);
                hessian.add(tets_(tet, a), tets_(tet, b),
                            stretches.u * block * stretches.u.transpose());
            }
    }
    for (std::size_t n = 0; n < fans_.size(); ++n) {
        const Fan& fan = fans_[n];
        const Eigen::Index first = static_cast<Eigen::Index>(n) * (kFanTets + 3);
        for (int a = 0; a < fan.nodes; ++a)
            for (int b = 0; b <= a; ++b)
                hessian.add(fan.node[a], fan.node[b],
                            (1 - kOwnVolume) * fan.bulk * of_mean.row(first + a).transpose() *
                                of_mean.row(first + b));
    }
}

}  // namespace risorius::tissue
