// SPDX-License-Identifier: MIT
/// \file
/// The fold angle between two triangles with a common edge, rad, and its derivatives by the positions of the corners, m.
///
///   x0, x1  ends of the edge, e = x1 - x0      xa, xb  the opposite corners      n1 = e x (xa - x0), n2 = (xb - x0) x e
///   theta = atan2((n1 x n2) . e / |e|, n1 . n2)   in (-pi, pi], 0 when flat, negative when folded towards n1 and n2
///
/// Exchanging x0 with x1 and also xa with xb does not change theta. Exchanging only xa and xb changes its sign.
///
/// Sources: Grinspun, Hirani, Desbrun & Schroeder 2003, Discrete shells; Tamstorf & Grinspun 2013, Discrete bending forces and
/// their Jacobians. The derivatives here were derived independently.
#pragma once

#include <array>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// The corners in the order x0, x1, xa, xb.
using HingeCorners = std::array<Vec3, 4>;

double hinge_angle(const HingeCorners& x);

/// dtheta/dx of each corner, rad/m.
std::array<Vec3, 4> hinge_angle_gradient(const HingeCorners& x);

/// Second derivative of theta, a 3 x 3 block for each pair of corners, rad/m^2.
std::array<std::array<Mat3, 4>, 4> hinge_angle_hessian(const HingeCorners& x);

}  // namespace risorius::tissue
