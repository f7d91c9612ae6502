// SPDX-License-Identifier: MIT
/// \file
/// The red of the lips at rest, seen from the front: the inside of the polygon of the landmarks on its border.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

class LipArea {
  public:
    /// Empty when too few landmarks of the border are given.
    explicit LipArea(const std::map<std::string, Vec3>& landmarks);

    bool contains(const Vec3& rest) const;

  private:
    std::vector<Vec2> border_;
    double behind_m_ = 0;  ///< z behind which nothing is lip
};

}  // namespace risorius::render
