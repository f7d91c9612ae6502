// SPDX-License-Identifier: MIT
/// \file
/// The mandible: its rigid motion, and the fraction of it that each point of the face follows.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

class Jaw {
  public:
    Jaw(const rig::Head& head, const rig::JawDescription& description);

    /// Motion of the mandible from rest. open 0..1, forward -0.2..1, side -1..1 (positive to the subject's left).
    Rigid motion(double open, double forward, double side) const;

    /// Fraction of the mandible's motion that the deep side of the tissue follows: 1 on the lower lip and chin, 0 above the occlusal line, with
    /// a transition over cheek and ramus; it fades down the neck.
    double weight(const Vec3& p) const { return weight(p, height_over_bite(p)); }
    /// The same for skin whose side of the bite is given (see bite_heights) instead of taken from its height.
    double weight(const Vec3& p, double height_over_bite_m) const;

    /// Displacement, m, of the floor of the mouth and the throat for every metre that the chin moves back. Tongue and floor hardly change
    /// volume, so they bulge downwards, and the hyoid moves down and back with them.
    Vec3 floor_bulge(const Vec3& p) const;
    /// Weight of tissue under the mandible behind the edge of the chin: 1 there and on the neck, 0 on the face.
    double in_floor(const Vec3& p) const;
    /// Distance that the chin has moved back, m.
    double chin_back(const Rigid& motion) const { return (chin() - motion * chin()).z(); }
    const Vec3& chin() const { return border_.front(); }

    /// Signed height over the line where the lips meet and, behind them, over the occlusal plane, m.
    double height_over_bite(const Vec3& p) const;

    /// Signed height over the lower border of the mandible, m.
    double height_over_border(const Vec3& p) const { return p.y() - border_height(p); }

  private:
    double border_height(const Vec3& p) const;

    double size_;
    Vec3 hinge_, slide_, forward_;
    double open_rad_, side_m_;
    double chin_ahead_m_;  // of the condyles
    Vec3 stomion_, corner_l_, corner_r_;
    std::vector<Vec3> border_;  // the lower edge of the mandible, both sides
};

struct Shell;

/// Height over the bite of every shell vertex, m. Lips touch and may roll over each other, so there the side comes from the distance
/// along the skin to the upper and the lower vermilion border.
std::vector<double> bite_heights(const rig::Head& head, const Jaw& jaw, const Shell& shell);

}  // namespace risorius::face
