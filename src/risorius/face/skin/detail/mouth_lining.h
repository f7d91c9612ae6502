// SPDX-License-Identifier: MIT
/// \file
/// Keeps the lining of the mouth behind the skin in front of it. Skin and lining move independently: the tissue moves the skin, and
/// skin_binding.h moves the lining. Where lips turn outwards, the lining would come through the skin.
///
///   x   a point of the lining      q   the point of the skin nearest to it at rest     n   outwards there     d = |q - x|
///   x moves by -n max(0, c - (q - x) . n),  c = min(d / 2, 1.5 mm):  nothing at rest
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

class MouthLining {
  public:
    explicit MouthLining(const rig::Head& head);

    /// V x 3, m, in the frame of the head.
    void stay_behind(Points& vertices) const;

    int points() const { return static_cast<int>(kept_.size()); }

  private:
    struct Kept {
        int vertex;
        std::array<int, 3> corner;
        Vec3 barycentric;
        double clearance_m;
    };
    std::vector<Kept> kept_;
    std::vector<std::pair<int, int>>
        alike_;  // a vertex, and the vertex at the same place that stands for it
};

}  // namespace risorius::face
