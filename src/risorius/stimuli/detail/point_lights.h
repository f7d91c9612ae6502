// SPDX-License-Identifier: MIT
/// \file
/// Point-light faces: white dots where landmarks are, on the background. They show the motion of a face without its form.
///
/// Source: Bassili 1978, Journal of Experimental Psychology: Human Perception and Performance 4(3).
#pragma once

#include <string>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/types.h"

namespace risorius::stimuli {

/// The dots of a clip.
class PointLights {
  public:
    /// The first `count` landmarks of a fixed order, in which each next one is farthest from those before; those that the table lacks
    /// are passed over. `radius_px` of a dot. `scattered`: each dot begins at a random place within the box around all of them in the
    /// first frame, and moves as before.
    PointLights(const animate::FrameRows& rows, int count, double radius_px, bool scattered,
                unsigned seed);

    /// Returns how much of each pixel the dots of a frame cover, 0 to 1.
    std::vector<float> covered(int frame, int width_px, int height_px) const;

    int count() const { return static_cast<int>(columns_.size()); }

  private:
    const animate::FrameRows& rows_;
    std::vector<int> columns_;  ///< of u_px; v_px is the next one
    std::vector<Vec2> moved_;   ///< px, added to all positions of a dot
    double radius_px_;
};

}  // namespace risorius::stimuli
