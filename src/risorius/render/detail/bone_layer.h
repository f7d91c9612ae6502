// SPDX-License-Identifier: MIT
/// \file
/// Draws skull, mandible and teeth under transparent skin. The surface of skin that is nearest to the camera is drawn over the
/// bones: clear where it faces the camera and pale where it is seen at a grazing angle.
#pragma once

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/moving_surface.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class BoneLayer {
  public:
    /// Throws Error for a scene without bones, and for triangles with a vertex index out of range.
    explicit BoneLayer(const Scene& scene);
    ~BoneLayer();
    BoneLayer(const BoneLayer&) = delete;
    BoneLayer& operator=(const BoneLayer&) = delete;

    /// Throws Error when the pose and the scene have different bones.
    void upload(const Pose& pose);

    /// Draws the bones, the teeth of `buffers` and the skin of `buffers` into the bound framebuffer, with the uniforms of the
    /// frame.
    void draw(const SceneBuffers& buffers) const;

  private:
    MovingSurface surface_;
    GlProgram bone_, skin_;
    GLsizei index_count_ = 0;
    GLuint array_ = 0, fixed_buffer_ = 0, elements_ = 0;
};

}  // namespace risorius::render
