// SPDX-License-Identifier: MIT
// GLSL of single hairs: light from all around, and a highlight across them.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

// Kajiya and Kay 1989, Rendering Fur with Three Dimensional Textures. Everything is computed per vertex of a hair.
constexpr const char* kHairVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_along;
layout(location = 2) in vec2 in_opacity_shade;
layout(binding = 0) uniform sampler2DShadow shadow_map;
uniform vec3 hair_tone;
out vec3 tone;
out float opacity;
void main() {
    vec3 t = in_along, v = normalize(camera.xyz - in_position), k = key_direction.xyz;
    // Half a millimetre off its own skin
    vec3 c = (shadow_from_world * vec4(in_position + 0.0015 * k, 1.0)).xyz;
    float s = textureLod(shadow_map, c, 0.0);
    float tk = dot(t, k), tv = dot(t, v);
    float around = sqrt(max(1.0 - tk * tk, 0.0));
    float mirror = max(around * sqrt(max(1.0 - tv * tv, 0.0)) - tk * tv, 0.0);
    mirror *= mirror; mirror *= mirror; mirror *= mirror; mirror *= mirror;
    vec3 light = key_card.rgb * (s * around) + 0.7 * fill_card.rgb + ambient(normalize(v - t * tv));
    tone = shown(hair_tone * in_opacity_shade.y * light + 0.03 * s * mirror * key_card.rgb);
    opacity = in_opacity_shade.x;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kHairFragment = R"(#version 450 core
in vec3 tone;
in float opacity;
out vec4 colour;
void main() { colour = vec4(tone, opacity); }
)";

}  // namespace

std::string strand_vertex_shader() { return frame_chunk() + lights_chunk() + kHairVertex; }
std::string strand_shader() { return kHairFragment; }

}  // namespace risorius::render
