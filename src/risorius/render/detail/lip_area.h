// The red of the lips at rest, seen from ahead: inside the polygon of the landmarks on its border.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

class LipArea {
  public:
    /// Holds nothing when too few of the border's landmarks are given.
    explicit LipArea(const std::map<std::string, Vec3>& landmarks);

    bool contains(const Vec3& rest) const;

  private:
    std::vector<Vec2> border_;
    double behind_m_ = 0;  ///< z of what is too far back to be lip
};

}  // namespace risorius::render
