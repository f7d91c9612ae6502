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

/// The mandible as the jaw channels place it.
class Jaw {
  public:
    Jaw(const rig::Head& head, const rig::JawDescription& description);

    /// Returns the motion of the mandible from rest. The arguments are fractions of the rig's ranges: open 0..1, forward -0.2..1, side
    /// -1..1 (positive to the subject's left).
    Rigid motion(double open, double forward, double side) const;

    /// Returns the fraction of the mandible's motion that the deep side of the tissue at p, m, follows: 1 on the lower lip and chin, 0 above
    /// the occlusal plane, with a transition over cheek and ramus. It fades down the neck.
    double weight(const Vec3& p) const { return weight(p, height_over_bite(p)); }
    /// The same with a given height over the bite (see bite_heights()), instead of height_over_bite(p).
    double weight(const Vec3& p, double height_over_bite_m) const;

    /// Returns the displacement of p on the floor of the mouth and the throat per metre that the chin moves back. Tongue and floor hardly
    /// change volume, so they bulge downwards, and the hyoid moves down and back with them.
    Vec3 floor_bulge(const Vec3& p) const;
    /// Returns 1 under the mandible, behind the edge of the chin, and on the neck; 0 on the face; values between at the transition.
    double in_floor(const Vec3& p) const;
    /// Returns the distance that the chin moves back in this motion of the mandible from rest, m.
    double chin_back(const Rigid& motion) const { return (chin() - motion * chin()).z(); }
    const Vec3& chin() const { return border_.front(); }

    /// Returns the signed height over the line where the lips meet and, behind them, over the occlusal plane, m.
    double height_over_bite(const Vec3& p) const;

    /// Returns the signed height over the lower border of the mandible, m.
    double height_over_border(const Vec3& p) const { return p.y() - border_height(p); }

  private:
    double border_height(const Vec3& p) const;

    double size_;  // of the head, relative to the standard head
    Vec3 hinge_, slide_, forward_;
    double open_rad_, side_m_;
    double chin_ahead_m_;  // distance of the chin in front of the condyles
    Vec3 stomion_, corner_l_, corner_r_;
    std::vector<Vec3> border_;  // the lower edge of the mandible, both sides
};

struct Shell;

/// Returns the height over the bite of every shell vertex, N, m. Lips touch and may roll over each other. So near the lips the height
/// comes from the distances along the skin to the vermilion borders: > 0 nearer to the upper, < 0 nearer to the lower border.
std::vector<double> bite_heights(const rig::Head& head, const Jaw& jaw, const Shell& shell);

}  // namespace risorius::face
