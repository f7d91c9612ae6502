// SPDX-License-Identifier: MIT
/// \file
/// Force and torque on a rigid body, as a sum of forces at points.
#pragma once

#include "risorius/core/types.h"

namespace risorius::face {

/// Force and torque about the origin of the head frame.
struct Wrench {
    Vec3 force_n = Vec3::Zero();
    Vec3 torque_nm = Vec3::Zero();

    /// Adds a force, N, that acts at `place`, m.
    void add(const Vec3& force, const Vec3& place) {
        force_n += force;
        torque_nm += place.cross(force);
    }
};

}  // namespace risorius::face
