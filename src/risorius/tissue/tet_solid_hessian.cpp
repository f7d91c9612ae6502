// SPDX-License-Identifier: MIT
// The second derivative of TetSolid, tet by tet in the frame of its principal stretches:
//   psi_i = mu s_i (s_i^2 - 1) + K (J - 1 + c min(0, J - J_c)) s_j s_k
#include <algorithm>
#include <array>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/principal_stretches.h"
#include "risorius/tissue/tet_solid.h"

namespace risorius::tissue {

namespace {

detail::StretchModes modes_of(const Vec3& s, double mu, double at_rest) {
    const double volume = s[0] * s[1] * s[2];
    const double crushed = std::min(0.0, volume - TetSolid::kCrushed);
    const double pressure = at_rest * (volume - 1 + TetSolid::kHardens * crushed);
    const double bulk = at_rest * (crushed < 0 ? 1 + TetSolid::kHardens : 1);
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
        detail::StretchModes modes =
            modes_of(stretches.sigma, rest_volume_[tet] * mu_[tet], rest_volume_[tet] * bulk_[tet]);
        if (curvature == solve::Curvature::kPositive) detail::clamp(modes);

        // Row k of the inverse is the gradient of the shape function of corner k + 1. The four gradients add up to zero.
        const Mat3 g = inverse * stretches.v;
        Vec3 gradient[4];
        for (int k = 0; k < 3; ++k) gradient[k + 1] = g.row(k).transpose();
        gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b) {
                const Mat3 block = detail::stretch_block(modes, gradient[a], gradient[b]);
                hessian.add(tets_(tet, a), tets_(tet, b),
                            stretches.u * block * stretches.u.transpose());
            }
    }
}

}  // namespace risorius::tissue
