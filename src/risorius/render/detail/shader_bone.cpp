// SPDX-License-Identifier: MIT
// GLSL of bone, and of glassy skin over it.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kBoneVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 8) in float in_open;
out vec3 position;
out vec3 normal;
out float open;
void main() {
    position = in_position;
    normal = in_normal;
    open = in_open;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kBoneFragment = R"(
in vec3 position;
in vec3 normal;
in float open;
out vec4 colour;

uniform vec3 albedo;
uniform bool closed_in;    // whether `open` is known

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    float sky = closed_in ? smoothstep(0.12, 0.85, open) : 0.9;
    // Lamps reach into a hollow too, but less far than they would with nothing around it
    vec3 key = key_card.rgb * scattered(dot(n, key_direction.xyz), vec3(0.10)) * mix(0.12, 0.80, sky);
    vec3 fill = fill_card.rgb * scattered(dot(n, fill_direction.xyz), vec3(0.10)) * mix(0.10, 0.80, sky);
    vec3 light = key + fill + ambient(n) * 0.9 * sky * sky;
    // What comes out of a hollow has met bone before
    vec3 seen = albedo * mix(vec3(0.80, 0.62, 0.48), vec3(1.0), sky);
    float gloss = glint(n, v, key_direction.xyz, 0.60, 0.018) * sky;
    colour = vec4(shown(seen * light + key_card.rgb * gloss), 1.0);
}
)";

constexpr const char* kGlassFragment = R"(
in vec3 position;
in vec3 normal;
out vec4 colour;

uniform vec3 tone;

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    float edge = 1.0 - clamp(dot(n, v), 0.0, 1.0);
    vec3 light = key_card.rgb * scattered(dot(n, key_direction.xyz), vec3(0.3)) * 0.7 + ambient(n);
    float gloss = glint(n, v, key_direction.xyz, 0.35, 0.04);
    float veil = clamp(0.10 + 0.62 * edge * edge * sqrt(edge) + gloss, 0.0, 1.0);
    colour = vec4(shown(tone * light + key_card.rgb * gloss), veil);
}
)";

}  // namespace

std::string bone_vertex_shader() { return frame_chunk() + kBoneVertex; }
std::string bone_shader() { return lighting_chunk() + kBoneFragment; }
std::string glass_vertex_shader() { return frame_chunk() + kBoneVertex; }
std::string glass_shader() { return lighting_chunk() + kGlassFragment; }

}  // namespace risorius::render
