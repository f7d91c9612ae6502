// SPDX-License-Identifier: MIT
/// \file
/// Hairs and freckles as thin quads on the paint map of the skin (skin_paint.h).
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Number of hairs of a brow of this appearance, where the usual number is given.
int brow_hairs(const Appearance& appearance, int usual);

/// A brow hair on the map. Hairs near the nose stand upright; farther out they lie more and more along the brow. Hairs of the
/// upper rows lean down, and those of the lower rows lean up.
struct BrowHair {
    Vec2 root, step;  ///< on the map, 0..1; step: 0.4 of the way from root to tip
    double length_m = 0, density = 1;
};
BrowHair next_brow_hair(const std::vector<Vec3>& line, double width, const Vec3& paint_centre,
                        RandomSequence& random);

/// The part of the map that the ears cover, on a grid of 256 x 256 cells.
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

/// Returns whether p (rest, m), seen from the front, lies on the red of the lips or less than 1.2 mm from a point of their
/// outline.
bool inside_lips(const SkinPlan& plan, const Vec3& p);

struct StrokeVertex {
    float place[2];  ///< on the map
    /// Position in the stroke: along it from 0 at the root to 1 at the tip, across it -1..1
    float local[2];
    float rgba[4];  ///< square root of the linear colour (3 numbers), and opacity
};

/// Returns the strokes of the head, six vertices each. No hair is drawn over ears. `centre`: see paint_centre(). `skin`: the
/// painted triangles, three vertex indices each.
std::vector<StrokeVertex> plan_strokes(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                                       const std::vector<unsigned>& skin);

/// Returns the area inside the outline of the lips, coloured in the tone of the lips, as the triangles of a fan.
std::vector<StrokeVertex> plan_lip_ground(const Scene& scene, const SkinPlan& plan,
                                          const Vec3& centre);

/// Blends the strokes over the bound framebuffer.
void draw_strokes(const std::vector<StrokeVertex>& strokes);

}  // namespace risorius::render
