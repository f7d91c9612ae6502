// SPDX-License-Identifier: MIT
/// \file
/// The light of a view: a key lamp with shadow, fill, a rim from behind, and surroundings, exposed on a grey card.
#pragma once

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/environment.h"
#include "risorius/render/detail/light.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {

/// A light before it is exposed, frame of the head.
struct LightPlan {
    Lamp key, fill, rim;
    Surroundings surroundings;
    Vec3 forward = Vec3::UnitZ();  ///< where the grey card looks
};

/// Throws Error for an unknown preset or numbers out of range. Presets go with the camera, which stands at this azimuth.
LightPlan plan_light(const LightOptions& options, double camera_azimuth_rad);

/// Factor per channel that makes a white card shine with 1.
Vec3 exposure_for(const LightPlan& plan, double exposure_ev);

class Lights {
  public:
    /// `height_px`: of the picture; low ones and drafts get a shadow of half as many places.
    Lights(const Camera& camera, const Vec3& head_centre, const LightOptions& options,
           int height_px, bool draft);
    ~Lights();
    Lights(const Lights&) = delete;
    Lights& operator=(const Lights&) = delete;

    /// Lights and shadow of all frames, for programs whose source begins with the frame.
    ShaderConstants constants() const;
    /// All but clip_from_world.
    FrameUniforms uniforms(const MouthGap& gap) const;

    /// Draws the shadow map of the bound scene, for what is seen in the clip space if one is given, and binds what lights look up.
    void draw_shadow(SceneBuffers& buffers, const Eigen::Matrix4f* clip_from_world) const;

  private:
    FrameUniforms frame_{};
    Eigen::Matrix4f clip_from_world_;
    GlProgram program_;
    GLint clip_location_ = -1;
    int shadow_side_;
    bool shadow_ = true;  ///< nothing to throw one without a key lamp
    GLuint shadow_map_ = 0, framebuffer_ = 0, mirror_ = 0;
};

}  // namespace risorius::render
