// SPDX-License-Identifier: MIT
/// \file
/// Hairs and freckles as thin quads on the paint map of the skin.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// The root of a brow hair on the map, and its direction: upright at the nose, then increasingly along the brow. Hairs of the
/// upper rows lean down, those of the lower rows up.
struct BrowHair {
    Vec2 root, step;  ///< step: a part of the way along the hair
    double length_m = 0, density = 1;
};
BrowHair next_brow_hair(const std::vector<Vec3>& line, const Vec3& paint_centre,
                        RandomSequence& random);

/// Cells of the map that the ears cover.
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

/// Whether p lies within the red of the lips or half a millimetre from it.
bool inside_lips(const SkinPlan& plan, const Vec3& p);

struct StrokeVertex {
    float place[2];  ///< on the map
    float local[2];  ///< along the stroke from root 0 to tip 1, across -1..1
    float rgba[4];   ///< square root of linear colour, opacity
};

/// Six vertices per stroke. `skin`: the painted triangles; no hair is drawn over ears.
std::vector<StrokeVertex> plan_strokes(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                                       const std::vector<unsigned>& skin);

/// The area inside the outline of the lips in their tone, as a triangle fan.
std::vector<StrokeVertex> plan_lip_ground(const Scene& scene, const SkinPlan& plan,
                                          const Vec3& centre);

/// Blends the strokes over the bound framebuffer.
void draw_strokes(const std::vector<StrokeVertex>& strokes);

}  // namespace risorius::render
