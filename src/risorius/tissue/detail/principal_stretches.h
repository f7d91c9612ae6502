// SPDX-License-Identifier: MIT
/// \file
/// Principal stretches of a deformation gradient, and the second derivative of an isotropic energy psi in the frame of these
/// stretches.
///
///   F = U diag(sigma) V^T,  U and V rotations; one sigma is negative where F is inverted
///
/// psi_i is dpsi/dsigma_i. In the frame U, V the second derivative of psi(sigma) splits into a 3 x 3 block A_ij for the
/// stretches and, for each pair (i, j), two numbers for its symmetric and antisymmetric off-diagonal change:
///   symmetric (psi_i - psi_j) / (sigma_i - sigma_j)      antisymmetric (psi_i + psi_j) / (sigma_i + sigma_j)
/// Clamping these at zero removes exactly the negative part. Source: Smith, De Goes & Kim 2019, "Analytic eigensystems for
/// isotropic distortion energies", ACM TOG 38(1).
#pragma once

#include <array>

#include "risorius/core/types.h"

namespace risorius::tissue::detail {

/// U, V and sigma of one deformation gradient.
struct PrincipalStretches {
    Mat3 u, v;
    Vec3 sigma;
};
PrincipalStretches principal_stretches(const Mat3& f);

/// The same for four deformation gradients at once, in the time of one and with the same bits.
std::array<PrincipalStretches, 4> principal_stretches(const std::array<Mat3, 4>& f);

/// The second derivative of psi in the frame U, V.
struct StretchModes {
    Mat3 along;          ///< A
    Vec3 symmetric;      ///< entry k belongs to the pair of axes other than k
    Vec3 antisymmetric;  ///< in the same order
};

/// Removes the negative part of the 3 x 3 block and of the numbers.
void clamp(StretchModes& modes);

/// The 3 x 3 block of the second derivative between two nodes, in the frame U. a and b are the gradients of their shape
/// functions in the frame V.
Mat3 stretch_block(const StretchModes& modes, const Vec3& a, const Vec3& b);

}  // namespace risorius::tissue::detail
