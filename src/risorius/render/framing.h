// SPDX-License-Identifier: MIT
/// \file
/// Where a view shows points of the world, without drawing.
#pragma once

#include <map>
#include <string>

#include "risorius/render/offscreen_view.h"

namespace risorius::render {

class Framing {
  public:
    /// `landmarks`: of the head at rest, m, as in Scene; `min`, `max`: the box of its skin. Throws Error as OffscreenView does.
    Framing(const std::map<std::string, Vec3>& landmarks, const Vec3& min, const Vec3& max,
            const ViewOptions& options);

    /// Returns what OffscreenView::project() returns for the same head and options, px.
    Vec2 project(const Vec3& world) const;

  private:
    Eigen::Matrix4d clip_from_world_;
    int width_px_, height_px_;
};

}  // namespace risorius::render
