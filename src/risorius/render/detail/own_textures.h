// SPDX-License-Identifier: MIT
/// \file
/// The textures that come with a mesh. That of the skin is painted into the paint map (skin_paint.h); those of eyes, teeth and
/// tongue are sampled in every frame.
#pragma once

#include <map>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class OwnTextures {
  public:
    /// The context must be current from here on. Throws Error for a surface whose texture or texture coordinates are missing.
    OwnTextures(const Scene& scene, const SceneBuffers& buffers);
    ~OwnTextures();
    OwnTextures(const OwnTextures&) = delete;
    OwnTextures& operator=(const OwnTextures&) = delete;

    /// Binds the texture of a batch for programs that use own_colour_chunk().
    void bind(const Batch& batch) const;

    /// Paints the colours of the skin over the bound framebuffer, as square roots of linear light; alpha is kept. `painted`:
    /// triangles on the paint map, see SceneBuffers::paintable_triangles().
    void paint_skin(const Scene& scene, const Vec3& paint_centre,
                    const std::vector<unsigned>& painted) const;

  private:
    /// Texture coordinates of a batch's triangles as linear functions of the rest position. This is correct across seams, where a
    /// vertex has several coordinates.
    struct Places {
        GLuint buffer = 0, texture = 0;
    };
    std::vector<GLuint> textures_;
    std::map<int, Places> places_;  ///< key: first index of the batch
};

}  // namespace risorius::render
