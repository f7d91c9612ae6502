// SPDX-License-Identifier: MIT
/// \file
/// The roof of the mouth above the tongue, as heights on a grid along and across the tongue: those of the lowest surface above it. On a
/// head without one, it is an estimate.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Heights at places that are evenly spaced from the root of the tongue to its tip, and from the right to the left.
struct PalateHeights {
    double from_x = 0, from_z = 0, step_x_m = 1, step_z_m = 1;
    std::vector<std::vector<double>> y;  ///< head frame, m; a row for each z
    /// Linear between the places; beyond them, as high as at the last one.
    double at(double x, double z) const;
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
    PalateHeights grid_;                    ///< without its heights
    std::vector<std::vector<Point>> rows_;  ///< the points across the tongue at each z
    bool found_ = false;
};

}  // namespace risorius::face
