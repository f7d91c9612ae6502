// SPDX-License-Identifier: MIT
/// \file
/// What is computed from a scene at rest, once, before its first picture: the sky that each vertex sees, the paint of the skin, and
/// where its hairs grow. All views of a scene share it. Sky and paint are kept in the cache (core/result_cache.h).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/detail/occlusion.h"
#include "risorius/render/detail/own_textures.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/strand_layer.h"
#include "risorius/render/scene.h"

namespace risorius::render {

struct BakeOptions {
    double sky_reach_m = 0;  ///< radius of the sphere in which surfaces hide the sky, m
    int paint_side = 0;      ///< texels per side of the paint map
    bool show_muscles = false;
};

struct BakedScene {
    std::vector<float> sky,
        inside;  ///< V: the sky that the vertex sees, 0..1; whether it lies inside the mouth
    std::optional<SkyAboutEyes> sky_about_eyes;
    std::vector<Strand> hair;  ///< brows and lashes
    bool mesh_lashes = true;   ///< whether the lashes of the mesh are drawn
    std::unique_ptr<OwnTextures> own;
    GLuint paint_map = 0, pore_map = 0;

    BakedScene() = default;
    BakedScene(const BakedScene&) = delete;
    BakedScene& operator=(const BakedScene&) = delete;
    ~BakedScene();  ///< in the context of the last view
};

/// `buffers`: bound, with the scene at rest; `centre`: see paint_centre(). The context must be current. Throws Error as OwnTextures does.
std::shared_ptr<BakedScene> bake_scene(const Scene& scene, SceneBuffers& buffers,
                                       const PosedMarks& marks, const Vec3& centre,
                                       const BakeOptions& options);

/// Returns the scene with a bare scalp and no beard. Hair would hide what lies below it; the brows stay.
Scene without_hair(Scene scene);

}  // namespace risorius::render
