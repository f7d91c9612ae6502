// SPDX-License-Identifier: MIT
/// \file
/// The light of a view: key lamp with shadow, fill, rim light from behind, and surroundings, exposed for a grey card.
#pragma once

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/environment.h"
#include "risorius/render/detail/light.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {

/// Light before exposure, in the head frame.
struct LightPlan {
    Lamp key, fill, rim;
    Surroundings surroundings;
    Vec3 forward = Vec3::UnitZ();  ///< normal of the grey card
};

/// Throws Error for an unknown preset and for numbers out of range. Presets move with the camera, whose azimuth is given.
LightPlan plan_light(const LightOptions& options, double camera_azimuth_rad);

/// Factor per channel that gives a white card the value 1.
Vec3 exposure_for(const LightPlan& plan, double exposure_ev);

class Lights {
  public:
    /// `height_px`: height of the picture. Small pictures and drafts get a shadow map with half as many texels per side.
    Lights(const Camera& camera, const Vec3& head_centre, const LightOptions& options,
           int height_px, bool draft);
    ~Lights();
    Lights(const Lights&) = delete;
    Lights& operator=(const Lights&) = delete;

    /// Constants of light and shadow, the same in all frames, for programs whose source begins with frame_chunk().
    ShaderConstants constants() const;
    /// All uniforms except clip_from_world.
    FrameUniforms uniforms(const MouthGap& gap) const;

    /// Draws the shadow map of the bound scene and binds the textures that lights read. With a clip space, only shadows that are
    /// visible in it are drawn.
    void draw_shadow(SceneBuffers& buffers, const Eigen::Matrix4f* clip_from_world) const;

  private:
    FrameUniforms frame_{};
    Eigen::Matrix4f clip_from_world_;
    GlProgram program_;
    GLint clip_location_ = -1;
    int shadow_side_;
    bool shadow_ = true;  ///< false without a key lamp
    GLuint shadow_map_ = 0, framebuffer_ = 0, mirror_ = 0;
};

}  // namespace risorius::render
