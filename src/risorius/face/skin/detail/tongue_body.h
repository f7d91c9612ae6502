// SPDX-License-Identifier: MIT
/// \file
/// The body of the tongue as an arch under the palate. At 1, its back touches the palate, however far the jaw is open, and does not
/// pass through it; below 0 the body lies lower than at rest. The arch has its top farther back or farther in front. The tip stays.
///
/// Points move upright, the back of the tongue more than its underside; by as much as it becomes higher, it becomes narrower.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/palate.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// A cross-section of the tongue at rest, m.
struct TongueSection {
    double top = 0, bottom = 0;  ///< from the middle line, both >= 0
    double half_width = 0;
};

/// A point of the tongue that its other channels have placed.
struct TonguePoint {
    double along;         ///< 0 at the root, 1 at the tip
    double side, height;  ///< from the middle line at rest, m
    Vec3 p;
};

/// The body of the tongue of one head.
class TongueBody {
  public:
    TongueBody() = default;
    /// `sections`: evenly spaced from the root, at `from_z`, to the tip, at `to_z`. `middle_y`: heights of the middle line there.
    TongueBody(const rig::Head& head, double from_z, double to_z,
               std::vector<TongueSection> sections, const std::vector<double>& middle_y);

    /// Moves all points of the tongue. `up`, `back`: the channels, [-1, 1]. `vertices`: the skin has already moved in them.
    void raise(double up, double back, const Points& vertices,
               std::vector<TonguePoint>& points) const;

  private:
    TongueSection section_at(double along) const;
    /// Rise of a point / rise of the middle of the back above it.
    double share(const TonguePoint& point, const TongueSection& section, double underside) const;

    double millimetre_ = 1e-3;
    std::vector<TongueSection> sections_;
    Palate palate_;
};

}  // namespace risorius::face
