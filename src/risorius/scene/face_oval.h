// SPDX-License-Identifier: MIT
/// \file
/// The oval of a face in a picture, from hairline to chin: a smooth convex curve through landmarks.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::scene {

class FaceOval {
  public:
    /// Returns the ids of the landmarks around the face, in no particular order.
    static const std::vector<std::string>& landmarks();

    /// `points`: the landmarks that the head has, in pixels. An oval of fewer than three points contains nothing.
    explicit FaceOval(std::vector<Vec2> points);

    bool contains(const Vec2& point) const;
    const std::vector<Vec2>& border() const { return border_; }
    /// Weights of all pixels of a picture, row by row: 1 inside, and outside a raised cosine that falls to 0 over `rim` of the oval's
    /// width.
    std::vector<float> soft_pixels(int width_px, int height_px, double rim) const;
    /// The pixels of a row whose centres lie in the oval: from `first` up to, but not including, `end`.
    struct Span {
        int first = 0, end = 0;
    };
    Span pixels_of_row(int y, int width_px) const;

  private:
    std::vector<Vec2> border_;  ///< corners of a convex polygon, in order
};

}  // namespace risorius::scene
