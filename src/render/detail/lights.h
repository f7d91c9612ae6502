// A soft three-point light that goes with the camera: key from one side of the face, fill, and a rim from behind.
#pragma once

#include "render/detail/camera.h"
#include "render/detail/posed_marks.h"
#include "render/detail/scene_buffers.h"
#include "render/detail/shaders.h"

namespace risorius::render {

class Lights {
  public:
    Lights(const Camera& camera, const Vec3& head_centre);
    ~Lights();
    Lights(const Lights&) = delete;
    Lights& operator=(const Lights&) = delete;

    /// All but clip_from_world.
    FrameUniforms uniforms(const MouthGap& gap) const;

    /// Draws the shadow map of the bound scene and binds it to kShadowUnit.
    void draw_shadow(const SceneBuffers& buffers) const;

  private:
    FrameUniforms frame_{};
    Eigen::Matrix4f clip_from_world_;
    GlProgram program_;
    GLuint shadow_map_ = 0, framebuffer_ = 0;
};

}  // namespace risorius::render
