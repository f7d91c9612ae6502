// SPDX-License-Identifier: MIT
/// \file
/// The line along which the lips meet. In the midline it is the deepest crease between nose and chin. From there it is followed
/// outwards to where the skin turns no more: the corners of the mouth.
#pragma once

#include <optional>

#include "risorius/landmarks/detail/front_rays.h"

namespace risorius::landmarks {

struct LipLine {
    Vec3 middle;                      ///< the stomion
    std::optional<Vec3> left, right;  ///< the corners, of the subject
};

/// `guess`: where the stomion is expected, up to 12 mm off. Returns nothing where there is no crease between lips.
std::optional<LipLine> find_lip_line(const FrontRays& rays, const Vec3& guess);

}  // namespace risorius::landmarks
