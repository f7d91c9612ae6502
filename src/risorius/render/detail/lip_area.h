// SPDX-License-Identifier: MIT
/// \file
/// The red of the lips at rest, seen from the front: the interior of a polygon of landmarks on its border.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

class LipArea {
  public:
    /// The area is empty when too many landmarks of the border are missing.
    explicit LipArea(const std::map<std::string, Vec3>& landmarks);

    bool contains(const Vec3& rest) const;

  private:
    std::vector<Vec2> border_;
    double behind_m_ = 0;  ///< z behind which nothing belongs to the lips
};

}  // namespace risorius::render
