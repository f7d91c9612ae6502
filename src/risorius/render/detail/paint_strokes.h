// SPDX-License-Identifier: MIT
/// \file
/// Hairs and freckles as thin quads on the skin map.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Where a hair of a brow grows on the map and which way: upright at the nose, then more and more along the brow; the upper rows
/// lean down, the lower ones up.
struct BrowHair {
    Vec2 root, step;  ///< step: part of the hair's way
    double length_m = 0, density = 1;
};
BrowHair next_brow_hair(const std::vector<Vec3>& line, const Vec3& paint_centre,
                        RandomSequence& random);

/// Cells of the map that ears cover.
class EarMask {
  public:
    EarMask(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
            const std::vector<unsigned>& skin);
    bool at(const Vec2& place) const { return covered_[cell(place)]; }

  private:
    static constexpr std::size_t kSide = 256;
    static std::size_t cell(const Vec2& place);
    std::vector<bool> covered_;
};

/// Within the red of the lips or half a millimetre from it.
bool inside_lips(const SkinPlan& plan, const Vec3& p);

struct StrokeVertex {
    float place[2];  ///< on the map
    float local[2];  ///< along 0..1 from the root, across -1..1
    float rgba[4];   ///< square root of linear colour, opacity
};

/// Six vertices per stroke. `skin` are the painted triangles: no hair is laid over those of ears.
std::vector<StrokeVertex> plan_strokes(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                                       const std::vector<unsigned>& skin);

/// The whole outline of the lips in their tone, as a fan.
std::vector<StrokeVertex> plan_lip_ground(const Scene& scene, const SkinPlan& plan,
                                          const Vec3& centre);

/// Blends them over the bound framebuffer.
void draw_strokes(const std::vector<StrokeVertex>& strokes);

}  // namespace risorius::render
