// SPDX-License-Identifier: MIT
/// \file
/// The fraction of the surroundings, called sky, that each vertex sees: at rest, and while the eyes close. It is measured by
/// rendering depth from many directions.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/scene_triangles.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Returns, per vertex, the cosine-weighted fraction 0..1 of directions that are not blocked. `positions`: V x 3, m. `normals`: 3
/// floats per vertex. `centre` and `radius_m`: a sphere around the scene. Draws the batches of the bound vertex array from 48
/// directions, each with one depth map of 512 x 512 texels. Lashes are left out, because their solid ribbons would darken the
/// lids. The context must be current.
std::vector<float> sky_seen(const Points& positions, const std::vector<float>& normals,
                            const std::vector<Batch>& batches, const Vec3& centre, double radius_m);

/// Smooths `seen` (one value per vertex) over the triangles of `corners` (three vertex indices each). In each pass, up to half of
/// a value comes from the neighbours of the vertex, with less weight for far neighbours and for normals that differ. The
/// smoothing is needed where a surface folds finely, because the depth maps make the values noisy from vertex to vertex there.
std::vector<float> with_neighbours(std::vector<float> seen, const Points& positions,
                                   const std::vector<float>& normals,
                                   const std::vector<unsigned>& corners, int passes);

/// The fraction of the sky that the skin sees while the lids close. The lid and its crease see more of the sky as the lid
/// unrolls. Near an eye, the value goes linearly from that of open eyes to that of closed eyes with the closure of that eye.
/// Elsewhere it is the value at rest.
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
