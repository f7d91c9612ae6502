// Hairs and freckles as thin quads on the skin map.
#pragma once

#include <cstdint>
#include <vector>

#include "render/detail/skin_plan.h"
#include "render/scene.h"

namespace risorius::render {

/// Uniform numbers in [0, 1), the same for a seed on every machine (splitmix64, Steele 2014).
class StrokeRandom {
  public:
    explicit StrokeRandom(std::uint64_t seed) : state_(seed) {}
    double next();

  private:
    std::uint64_t state_;
};

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
