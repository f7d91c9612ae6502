// SPDX-License-Identifier: MIT
/// \file
/// The mesh's own textures: baked into the paint of the skin, and sampled on eyes, teeth and tongue.
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

    /// For the programs that take their colour from own_colour_chunk().
    void bind(const Batch& batch) const;

    /// Colours of the skin over what the bound framebuffer shows, as square roots; alpha stays. `painted` are the triangles that
    /// the map of the paint shows, see SceneBuffers::paintable_triangles().
    void paint_skin(const Scene& scene, const Vec3& paint_centre,
                    const std::vector<unsigned>& painted) const;

  private:
    /// Texture coordinates of a batch's triangles as linear functions of the rest position: right across seams, where a vertex
    /// has several.
    struct Places {
        GLuint buffer = 0, texture = 0;
    };
    std::vector<GLuint> textures_;
    std::map<int, Places> places_;  ///< by the batch's first index
};

}  // namespace risorius::render
