// SPDX-License-Identifier: MIT
/// \file
/// The light of a view: the key lamp (main light) with its shadow, the fill lamp that brightens shadows, the rim lamp behind the
/// head, and the surroundings. All are scaled by the exposure for a grey card.
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

/// Returns the light for the options. Presets move with the camera, whose azimuth is given. Throws Error for an unknown preset
/// and for numbers out of range.
LightPlan plan_light(const LightOptions& options, double camera_azimuth_rad);

/// Sets the light of a preset for a tone of skin, sRGB. With the darkest skin, fill and surroundings are 1.8 times as strong. Returns
/// the stops by which the exposure is to grow, 0 to 0.8. Both grow with skin_darkness().
double suit_skin(const Vec3& skin_tone, LightPlan& plan);

/// Returns the factor per channel that gives a white card at the face the value 1, times 2^exposure_ev.
Vec3 exposure_for(const LightPlan& plan, double exposure_ev);

class LockLayer;

class Lights {
  public:
    /// `skin_tone`: sRGB. `height_px`: height of the picture. Small pictures and drafts get a shadow map with half as many texels per
    /// side.
    Lights(const Camera& camera, const Vec3& head_centre, const LightOptions& options,
           const Vec3& skin_tone, int height_px, bool draft);
    ~Lights();
    Lights(const Lights&) = delete;
    Lights& operator=(const Lights&) = delete;

    /// Constants of light and shadow, the same in all frames, for programs whose source begins with frame_chunk().
    ShaderConstants constants() const;
    /// Returns the uniforms of a frame, all but clip_from_world.
    FrameUniforms uniforms(const MouthGap& gap) const;

    /// Draws the shadow map of the bound scene and binds the textures that the shaders read for light. If `clip_from_world` is
    /// not null, only triangles whose shadows can be visible in that clip space are drawn. `locks`: hair that throws shadow, or
    /// null.
    void draw_shadow(SceneBuffers& buffers, const Eigen::Matrix4f* clip_from_world,
                     const LockLayer* locks) const;

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
