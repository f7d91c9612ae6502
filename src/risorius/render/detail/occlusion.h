// SPDX-License-Identifier: MIT
/// \file
/// How much of the sky each vertex sees, from depth renders along many directions: at rest, and about eyes that shut.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/scene_triangles.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Cosine-weighted fraction of unblocked directions, 0..1 per vertex. Draws the batches of the bound vertex array except lashes, whose ribbons
/// would darken the lids as if they were solid; the context must be current. 48 directions, one depth render of 512 x 512 each.
std::vector<float> sky_seen(const Points& positions, const std::vector<float>& normals,
                            const std::vector<Batch>& batches, const Vec3& centre, double radius_m);

/// Each time up to half of it from the vertices around in triangles of `corners`, less the farther they are and the more they are turned
/// away: maps of so few points are noise from one vertex to the next where a surface folds finely.
std::vector<float> with_neighbours(std::vector<float> seen, const Points& positions,
                                   const std::vector<float>& normals,
                                   const std::vector<unsigned>& corners, int passes);

/// What the skin sees while the lids close: crease and lid come to the light as one unrolls from the other. Between the eyes open
/// and shut it changes with each eye's own closure; away from the eyes it is that of rest.
class SkyAboutEyes {
  public:
    SkyAboutEyes(const Scene& scene, std::vector<float> at_rest, const std::vector<float>& shut);
    const std::vector<float>& seen(const std::array<double, 2>& closed);

  private:
    struct Near {
        int vertex, eye;
        float change;
    };
    std::vector<Near> near_;
    std::vector<float> at_rest_, seen_;
};

}  // namespace risorius::render
