// The oval of a face in a picture, from hairline to chin: a smooth convex curve through its landmarks.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::scene {

class FaceOval {
  public:
    /// Around the face, in no order.
    static const std::vector<std::string>& landmarks();

    /// Where those of them are that there are, pixels; an oval of fewer than three holds nothing.
    explicit FaceOval(std::vector<Vec2> points);

    bool holds(const Vec2& point) const;
    /// The centres of so many pixels of a row that it holds: those from `first` up to but not `end`. It is convex.
    struct Span {
        int first = 0, end = 0;
    };
    Span pixels_of_row(int y, int width_px) const;

  private:
    std::vector<Vec2> border_;  ///< corners, all turning the same way
};

}  // namespace risorius::scene
