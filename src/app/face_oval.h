// The oval of a face in a picture, from hairline to chin: a smooth convex curve through its landmarks.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"

namespace risorius::app {

class FaceOval {
  public:
    /// Around the face, in no order.
    static const std::vector<std::string>& landmarks();

    /// Where those of them are that there are, pixels; an oval of fewer than three holds nothing.
    explicit FaceOval(std::vector<Vec2> points);

    bool holds(const Vec2& point) const;

  private:
    std::vector<Vec2> border_;  ///< corners, all turning the same way
};

}  // namespace risorius::app
