// SPDX-License-Identifier: MIT
/// \file
/// Where hair covers the skin, by the plan that paints it: brows and scalp.
#pragma once

#include <array>
#include <optional>

#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"
#include "risorius/render/surface_passes.h"

namespace risorius::render {

class HairArea {
  public:
    /// Has no hair when the skin is a picture of the mesh's own.
    explicit HairArea(const Scene& scene);

    /// Kind of hair at a place of the skin at rest.
    std::optional<Part> at(const Vec3& rest) const;

  private:
    Vec3 centre_ = Vec3::Zero();
    SkinPlan plan_;
    bool scalp_ = false;
};

}  // namespace risorius::render
