// SPDX-License-Identifier: MIT
/// \file
/// The matrix of a cross product: cross_matrix(a) b = a x b.
#pragma once

#include "risorius/core/types.h"

namespace risorius {

inline Mat3 cross_matrix(const Vec3& a) {
    Mat3 m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

}  // namespace risorius
