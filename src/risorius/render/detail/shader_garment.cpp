// SPDX-License-Identifier: MIT
// GLSL of the shirt: knitted cloth, without gloss, with a ribbed collar.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kGarmentVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_cloth;     // m below the border, m around the neck
out vec3 position;
out vec3 normal;
out vec2 cloth;
void main() {
    position = in_position;
    normal = in_normal;
    cloth = in_cloth;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

// Patterns finer than two samples fade out.
constexpr const char* kGarment = R"(
in vec3 normal;
in vec2 cloth;
out vec4 colour;
uniform vec3 garment_tone;    // linear

float seen(float period) { return 1.0 - smoothstep(0.25, 0.5, max(fwidth(cloth.x), fwidth(cloth.y)) / period); }

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    float collar = 1.0 - smoothstep(0.0130, 0.0136, cloth.x);
    float ribs = 0.5 + 0.5 * sin(6.2832 * cloth.y / 0.0022);
    float knit = sin(6.2832 * cloth.y / 0.0011) * sin(6.2832 * cloth.x / 0.0013);
    vec3 albedo = garment_tone * (1.0 + 0.10 * knit * seen(0.0011) * (1.0 - collar)) * mix(1.0, 0.86 + 0.20 * ribs, collar * seen(0.0022));
    // The seam below the collar, and the border, where the cloth turns in
    float seam = (cloth.x - 0.0145) / 0.0010;
    albedo *= 1.0 - 0.45 * exp(-seam * seam);
    albedo *= 0.55 + 0.45 * smoothstep(0.0, 0.0022, cloth.x);
    // The head hides some of the sky near the neck.
    float open = 0.72 + 0.28 * smoothstep(0.0, 0.06, cloth.x);
    float s = key_visibility(position, n);
    vec3 light = key_card.rgb * (s * clamp((dot(n, key_direction.xyz) + 0.15) / 1.15, 0.0, 1.0));
    light += open * (fill_card.rgb * clamp(dot(n, fill_direction.xyz), 0.0, 1.0) + ambient(n));
    light += rim_card.rgb * clamp(dot(n, rim_direction.xyz), 0.0, 1.0);
    // Fibres that stand off shine at a slant.
    float slant = 1.0 - clamp(dot(n, v), 0.0, 1.0);
    colour = vec4(shown(albedo * light * (1.0 + 0.5 * slant * slant * slant)), told());
}
)";

}  // namespace

std::string garment_vertex_shader() { return frame_chunk() + kGarmentVertex; }
std::string garment_shader(bool layer) {
    return lighting_chunk() + "in vec3 position;\n" + told_chunk(layer) + kGarment;
}

}  // namespace risorius::render
