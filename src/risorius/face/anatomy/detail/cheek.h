// SPDX-License-Identifier: MIT
/// \file
/// The cheek beside the nasolabial fold: soft skin along a crease, and the malar fat pad that the skin folds against.
///
/// Muscles that lift the lip attach in front of the fold and pass under the fat, which ligaments hold over the cheekbone. So the
/// skin shortens across the crease, by a third in a measured smile, while the cheek behind it moves as one piece.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// The regions of crease and fat pad on a head at rest, as weights 0..1.
class CheekRegions {
  public:
    explicit CheekRegions(const rig::Head& head);

    /// Returns the weight of the crease at a skin point p, m: 1 in a strip beside the line from nose wing to mouth corner, 0 away from it.
    double crease(const Vec3& p) const;
    /// Returns the weight of the fat pad at p, m: 1 in its middle below the cheekbone, 0 in the crease and away from the pad.
    double fat(const Vec3& p) const;

  private:
    double mm_;
    std::array<std::vector<Vec3>, 2> crease_;
    std::array<Vec3, 2> fat_;
};

}  // namespace risorius::face
