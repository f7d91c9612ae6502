// SPDX-License-Identifier: MIT
/// \file
/// How much of the sky each vertex sees, measured by depth renders along many directions: at rest, and while the eyes close.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/scene_triangles.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Cosine-weighted fraction of directions that are not blocked, 0..1 per vertex. Draws the batches of the bound vertex array.
/// Lashes are left out, because their solid ribbons would darken the lids. Uses 48 directions, each with one depth render of 512
/// x 512. The context must be current.
std::vector<float> sky_seen(const Points& positions, const std::vector<float>& normals,
                            const std::vector<Batch>& batches, const Vec3& centre, double radius_m);

/// Smooths `seen` over the triangles of `corners`. In each pass up to half of a value comes from the vertices around it, with
/// less weight for far ones and for normals that differ. Where a surface folds finely, depth maps of this size are noisy from
/// vertex to vertex.
std::vector<float> with_neighbours(std::vector<float> seen, const Points& positions,
                                   const std::vector<float>& normals,
                                   const std::vector<unsigned>& corners, int passes);

/// The sky that the skin sees while the lids close: the crease and the lid come to light as the lid unrolls. Near an eye the
/// value moves from that of open to that of closed eyes with the eye's closure; elsewhere it is that of rest.
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
