// SPDX-License-Identifier: MIT
/// \file
/// The roof of the mouth above the tongue, as heights along the tongue: the lowest surface above a strip about its middle. On a head
/// without one, it is an estimate.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Heights at places that are evenly spaced from the root of the tongue to its tip.
struct PalateHeights {
    double from_z = 0, step_m = 1;
    std::vector<double> y;  ///< head frame, m
    double at(double z) const;
};

/// The palate of one head.
class Palate {
  public:
    Palate() = default;
    /// `dorsum_y`: heights of the back of the tongue at rest, at places evenly spaced from `from_z` to `to_z`, m.
    Palate(const rig::Head& head, double from_z, double to_z, const std::vector<double>& dorsum_y);

    /// Returns its heights over `vertices`, in which the skin has already moved.
    PalateHeights heights(const Points& vertices) const;
    /// Whether the head has a surface there; else its height is an estimate.
    bool found() const { return found_; }

  private:
    /// A point of the roof as a mean of vertices, which moves with them.
    struct Point {
        std::vector<std::pair<int, double>> of;  ///< vertex, weight
        double y = 0;                            ///< if there are none
    };
    double from_z_ = 0, step_m_ = 1;
    std::vector<std::vector<Point>> rows_;  ///< the points across the tongue at each place
    bool found_ = false;
};

}  // namespace risorius::face
