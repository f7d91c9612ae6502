// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lights.h"

#include <cmath>
#include <cstring>

#include "risorius/render/detail/lock_layer.h"

namespace risorius::render {
namespace {

constexpr int kShadowSide = 1024;
/// Pictures of at most this height use half the shadow map: their pixels are wider than its texels
constexpr int kLow_px = 640;
/// Pixel size of close-ups, in which texels of the map would show
constexpr double kClose_m = 0.12e-3;
/// Half width of the map, ratio to the height of the frame
constexpr double kShadowReachPerFrame = 0.62;

int shadow_side(const Camera& camera, int height_px, bool draft) {
    if (draft || height_px <= kLow_px) return kShadowSide / 2;
    return camera.frame_height_m < kClose_m * height_px ? 2 * kShadowSide : kShadowSide;
}

void put(float* to, const Vec3& v) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(v[k]);
}

}  // namespace

Lights::Lights(const Camera& camera, const Vec3& head_centre, const LightOptions& options,
               const Vec3& skin_tone, int height_px, bool draft)
    : program_("shadow", depth_vertex_shader(), ""),
      clip_location_(program_.location("clip_from_world")),
      shadow_side_(shadow_side(camera, height_px, draft)) {
    LightPlan plan = plan_light(options, camera.azimuth_rad);
    const double more_ev =
        options.meter == Meter::kSkin && !options.surroundings ? suit_skin(skin_tone, plan) : 0.0;
    const Vec3 exposure = exposure_for(plan, options.exposure_ev + more_ev),
               key = plan.key.direction;
    shadow_ = plan.key.card.maxCoeff() > 0;
    put(frame_.camera, camera.eye_point());
    put(frame_.key_direction, key);
    put(frame_.key_card, plan.key.card.cwiseProduct(exposure));
    put(frame_.fill_direction, plan.fill.direction);
    put(frame_.fill_card, plan.fill.card.cwiseProduct(exposure));
    put(frame_.rim_direction, plan.rim.direction);
    put(frame_.rim_card, plan.rim.card.cwiseProduct(exposure));
    const Irradiance irradiance = irradiance_of(plan.surroundings);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        put(frame_.irradiance[i], irradiance[i].cwiseProduct(exposure));
    mirror_ = mirror_texture(plan.surroundings, exposure);

    const double reach = kShadowReachPerFrame * camera.portrait_height_m;
    const Vec3 across =
        (std::abs(key.y()) > 0.999 ? Vec3::UnitX() : Vec3::UnitY().cross(key)).normalized();
    const Vec3 up = key.cross(across);
    Mat4 clip = Mat4::Identity();
    clip.block<1, 3>(0, 0) = across.transpose() / reach;
    clip.block<1, 3>(1, 0) = up.transpose() / reach;
    clip.block<1, 3>(2, 0) = -key.transpose() / (2 * reach);
    clip.block<3, 1>(0, 3) = -clip.block<3, 3>(0, 0) * head_centre;
    clip_from_world_ = clip.cast<float>();
    Mat4 texture = Mat4::Identity();
    texture.block<3, 3>(0, 0) *= 0.5;
    texture.block<3, 1>(0, 3).setConstant(0.5);
    const Eigen::Matrix4f shadow = (texture * clip).cast<float>();
    std::memcpy(frame_.shadow_from_world, shadow.data(), sizeof frame_.shadow_from_world);
    frame_.shadow_places[0] = static_cast<float>(shadow_side_);
    frame_.shadow_places[1] = static_cast<float>(2 * reach / shadow_side_);

    glGenTextures(1, &shadow_map_);
    glBindTexture(GL_TEXTURE_2D, shadow_map_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, shadow_side_, shadow_side_);
    const GLint filter = draft ? GL_NEAREST : GL_LINEAR;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
}

Lights::~Lights() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &shadow_map_);
    glDeleteTextures(1, &mirror_);
}

ShaderConstants Lights::constants() const {
    std::string text = "#define LIGHTS_TOLD\nconst mat4 shadow_from_world = " +
                       glsl("mat4", frame_.shadow_from_world) + ";\n";
    const auto set_uniform = [&](const char* name, std::span<const float> four) {
        text += std::string("const vec4 ") + name + " = " + glsl("vec4", four) + ";\n";
    };
    set_uniform("shadow_places", frame_.shadow_places);
    set_uniform("camera", frame_.camera);
    set_uniform("key_direction", frame_.key_direction);
    set_uniform("key_card", frame_.key_card);
    set_uniform("fill_direction", frame_.fill_direction);
    set_uniform("fill_card", frame_.fill_card);
    set_uniform("rim_direction", frame_.rim_direction);
    set_uniform("rim_card", frame_.rim_card);
    text += "const vec4 irradiance[9] = vec4[9](";
    for (const auto& four : frame_.irradiance)
        text += glsl("vec4", four) + (&four == &frame_.irradiance[8] ? ");\n" : ", ");
    ShaderConstants constants;
    constants.set_prelude(text);
    return constants;
}

FrameUniforms Lights::uniforms(const MouthGap& gap) const {
    FrameUniforms frame = frame_;
    put(frame.mouth_centre, gap.centre);
    frame.mouth_centre[3] = static_cast<float>(gap.area_m2);
    put(frame.mouth_axis, gap.half_axis);
    return frame;
}

void Lights::draw_shadow(SceneBuffers& buffers, const Eigen::Matrix4f* clip_from_world,
                         const LockLayer* locks) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, shadow_side_, shadow_side_);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2.0F, 4.0F);
    glClear(GL_DEPTH_BUFFER_BIT);
    program_.use();
    glUniformMatrix4fv(clip_location_, 1, GL_FALSE, clip_from_world_.data());
    // The skin casts all visible shadows but those of hair: on itself, on the eyes and on the teeth.
    if (shadow_) {
        buffers.choose_casters(clip_from_world_, clip_from_world);
        for (const Batch& batch : buffers.batches()) buffers.draw(batch, Purpose::kShadow);
        if (locks) {
            locks->draw_casters();
            buffers.bind();
        }
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glActiveTexture(GL_TEXTURE0 + kShadowUnit);
    glBindTexture(GL_TEXTURE_2D, shadow_map_);
    glActiveTexture(GL_TEXTURE0 + kMirrorUnit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, mirror_);
}

}  // namespace risorius::render
