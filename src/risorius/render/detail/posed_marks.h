// SPDX-License-Identifier: MIT
/// \file
/// Landmarks that move with the skin, and the openings of mouth and eyes, on which the light inside them depends.
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

    /// Lips that are closed have no gap, even if they stand apart in the rest pose.
    MouthGap mouth_gap(const Pose& pose) const;
    LidMarks lids(const Pose& pose, int eye) const;
    /// Closure of the lids relative to rest, 0..1.
    double lids_closed(const Pose& pose, int eye) const;

    /// 1 for a skin vertex inside the closed mouth, 0 outside, found from its position and from how little sky it sees.
    std::vector<float> inside_mouth(const Scene& scene, const std::vector<float>& sky_seen) const;

  private:
    int stos_ = -1, stoi_ = -1, ch_l_ = -1, ch_r_ = -1;  ///< nearest skin vertices
    double rest_gap_m_ = 0.0;
    std::array<double, 2> rest_opening_{};  ///< height over width of the eyes
    Vec3 mouth_rest_ = Vec3::Zero();        ///< fallback without lip landmarks
    std::array<std::array<int, 4>, 2> lids_{{{-1, -1, -1, -1}, {-1, -1, -1, -1}}};
};

}  // namespace risorius::render
