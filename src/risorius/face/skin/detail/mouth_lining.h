// SPDX-License-Identifier: MIT
/// \file
/// Keeps the lining of the mouth behind the skin in front of it. The two move independently: the tissue moves the skin, and the harmonic
/// extension (skin_binding.h) moves the lining. So where lips turn outwards, the lining would come through the skin.
///
///   x   a point of the lining      q   the point of the skin that is nearest to it at rest     n   outward normal of the skin at q
///   d = |q - x| at rest            c = min(d / 2, 1.5 mm)
///   x moves by -n max(0, c - (q - x) . n). At rest it does not move.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// The points of the lining of one head that lie behind skin.
class MouthLining {
  public:
    explicit MouthLining(const rig::Head& head);

    /// Moves the points of the lining in `vertices`, V x 3, m, head frame.
    void stay_behind(Points& vertices) const;

    /// Returns the number of these points.
    int points() const { return static_cast<int>(kept_.size()); }

  private:
    struct Kept {
        int vertex;
        std::array<int, 3> corner;
        Vec3 barycentric;
        double clearance_m;
    };
    std::vector<Kept> kept_;
    /// A vertex, and the vertex at the same place that it copies.
    std::vector<std::pair<int, int>> alike_;
};

}  // namespace risorius::face
