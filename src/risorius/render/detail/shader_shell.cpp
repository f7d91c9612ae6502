// SPDX-License-Identifier: MIT
// GLSL of hair as shells: where a hair passes through a shell, and how it is lit.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kShellVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_rest;
layout(location = 3) in vec2 in_paint;
layout(location = 4) in vec3 in_occlusion;
layout(binding = 0) uniform sampler2DShadow shadow_map;
layout(binding = 10) uniform sampler2D length_map;   // shares of the full length: scalp, beard
uniform vec3 whorl;          // rest, m
uniform vec2 full_length;    // m, of scalp and beard
uniform float shells;
out vec3 position;
out vec3 rest;
out vec2 paint;
out vec3 along;
out float height;            // 0 at the skin .. 1
out float lit;
out vec3 soft;
void main() {
    vec2 share = textureLod(length_map, in_paint, 0.0).rg * vec2(full_length.x > 0.0, full_length.y > 0.0);
    bool beard = share.y > share.x;
    float length_ = beard ? full_length.y : full_length.x;
    height = float(gl_InstanceID + 1) / shells;
    // Away from the whorl and down, in a bow that leans over the farther out
    vec3 lie = beard ? vec3(0.0, -1.0, 0.15) : in_rest - whorl + vec3(0.0, -0.03, 0.0);
    lie = normalize(lie - in_normal * dot(lie, in_normal) + 1e-4);
    float lean = beard ? 1.0 : 0.75;
    vec3 p = in_position + length_ * (in_normal * (height - 0.38 * height * height) + lie * (lean * height * (0.25 + 0.5 * height)));
    along = normalize(in_normal * (1.0 - 0.76 * height) + lie * (lean * (0.25 + height)));
    position = p;
    rest = in_rest;
    paint = in_paint;
    vec3 c = (shadow_from_world * vec4(p + 0.004 * in_normal, 1.0)).xyz;
    lit = textureLod(shadow_map, c, 0.0);
    soft = in_occlusion.x * (0.7 * fill_card.rgb * clamp(0.5 + 0.5 * dot(in_normal, fill_direction.xyz), 0.0, 1.0) + ambient(in_normal) +
           0.35 * rim_card.rgb * max(dot(in_normal, rim_direction.xyz), 0.0));
    gl_Position = clip_from_world * vec4(p, 1.0);
}
)";

constexpr const char* kShell = R"(
in vec3 position;
in vec3 rest;
in vec2 paint;
in vec3 along;
in float height;
in float lit;
in vec3 soft;
out vec4 colour;
layout(binding = 10) uniform sampler2D length_map;
uniform vec2 full_length;
uniform vec3 centre;
uniform vec3 hair_tone;

void main() {
    vec2 share = texture(length_map, paint).rg * vec2(full_length.x > 0.0, full_length.y > 0.0);
    bool beard = share.y > share.x;
    float grown = max(share.x, share.y);
    // Hairs stand in cells of a map from the crown, or for a beard from the front: there it is hardly stretched.
    vec3 d = normalize(rest - centre);
    vec2 place = beard ? 0.4 * (paint - 0.5) : 0.1 * sqrt(2.0 / (1.05 + d.y)) * d.xz;
    vec2 cell = place / 0.00050;
    // Locks: neighbours lean together towards their tips.
    vec3 lock = vec3(cell * 0.13 + 300.0, 3.0);
    cell += 1.6 * height * (vec2(noise(lock), noise(lock + 50.0)) - 0.5);
    vec3 id = vec3(floor(cell) + 5000.0, beard ? 1.0 : 2.0);
    float draw = hash(id), tall = 0.62 + 0.38 * hash(id + 7.0);
    vec2 middle = 0.5 + 0.4 * (vec2(hash(id + 11.0), hash(id + 13.0)) - 0.5);
    float off = length(fract(cell) - middle);
    float end = tall * smoothstep(0.0, 0.85, grown);
    float radius = 0.46 * (1.0 - 0.75 * height / max(end, 1e-3));
    if (draw > 0.25 + 1.2 * grown || height > end || off > radius) discard;

    vec3 t = normalize(along + 0.25 * (vec3(hash(id + 17.0), hash(id + 19.0), hash(id + 23.0)) - 0.5));
    vec3 v = normalize(camera.xyz - position), k = key_direction.xyz;
    // Kajiya and Kay 1989; roots lie in the shade of the hair above them.
    float tk = dot(t, k), tv = dot(t, v);
    float around = sqrt(max(1.0 - tk * tk, 0.0));
    float mirror = max(around * sqrt(max(1.0 - tv * tv, 0.0)) - tk * tv, 0.0);
    float m2 = mirror * mirror, m4 = m2 * m2, m8 = m4 * m4, m16 = m8 * m8;
    float deep = mix(0.22, 1.15, height / max(end, 1e-3));
    float shade = (0.45 + 0.9 * hash(id + 29.0)) * (0.75 + 0.5 * noise(lock * 1.7));
    vec3 c = hair_tone * shade * deep * (key_card.rgb * lit * around + 1.2 * soft);
    c += lit * deep * key_card.rgb * (0.022 * m16 + hair_tone * 0.25 * m8);
    colour = vec4(shown(c), 1.0);
}
)";

}  // namespace

std::string shell_vertex_shader() { return frame_chunk() + lights_chunk() + kShellVertex; }
std::string shell_shader() { return frame_chunk() + lights_chunk() + noise_chunk() + kShell; }

}  // namespace risorius::render
