// SPDX-License-Identifier: MIT
/// \file
/// Landmarks that move with the skin, and from them the openings of mouth and eyes. The light inside the mouth and on the eyes
/// depends on these openings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/render/scene.h"

namespace risorius::render {

/// The gap between the lips.
struct MouthGap {
    Vec3 centre = Vec3::Zero();
    Vec3 half_axis = Vec3::Zero();  ///< from the centre towards the left corner
    double area_m2 = 0.0;
};

/// Landmarks on the lid margins of one eye.
struct LidMarks {
    bool known = false;
    Vec3 inner = Vec3::Zero(), outer = Vec3::Zero(), upper = Vec3::Zero(), lower = Vec3::Zero();
};

class PosedMarks {
  public:
    PosedMarks(const Scene& scene);

    /// Returns the gap between the lips. A gap that is no larger than that of the rest pose counts as closed and has no area.
    MouthGap mouth_gap(const Pose& pose) const;
    LidMarks lids(const Pose& pose, int eye) const;
    /// Returns the closure of the lids: 0 as open as at rest, 1 closed.
    double lids_closed(const Pose& pose, int eye) const;

    /// Returns 1 for each skin vertex inside the closed mouth, and 0 for those outside. It is inside if its position is near the
    /// mouth and it sees little of the sky (occlusion.h).
    std::vector<float> inside_mouth(const Scene& scene, const std::vector<float>& sky_seen) const;

  private:
    /// Skin vertices nearest to the landmarks of these names
    int stos_ = -1, stoi_ = -1, ch_l_ = -1, ch_r_ = -1;
    double rest_gap_m_ = 0.0;
    /// At rest: height over width of the opening between the lids
    std::array<double, 2> rest_opening_{};
    Vec3 mouth_rest_ = Vec3::Zero();  ///< fallback without lip landmarks
    std::array<std::array<int, 4>, 2> lids_{{{-1, -1, -1, -1}, {-1, -1, -1, -1}}};
};

}  // namespace risorius::render
