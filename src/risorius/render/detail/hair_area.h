// SPDX-License-Identifier: MIT
/// \file
/// The areas of the skin that brows and hair of the scalp cover. They follow from the same SkinPlan that paints them.
#pragma once

#include <array>
#include <optional>

#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"
#include "risorius/render/surface_passes.h"

namespace risorius::render {

class HairArea {
  public:
    /// The areas are empty when the skin has a texture of its own.
    explicit HairArea(const Scene& scene);

    /// The kind of hair at a point of the skin at rest, or none.
    std::optional<Part> at(const Vec3& rest) const;

  private:
    Vec3 centre_ = Vec3::Zero();
    SkinPlan plan_;
    bool scalp_ = false;
    double brow_width_ = 1;
};

}  // namespace risorius::render
