// SPDX-License-Identifier: MIT
// GLSL of the line of tears along the lower lid.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kTearVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in float in_share;
layout(binding = 0) uniform sampler2DShadow shadow_map;
out vec3 position;
out vec3 normal;
out float share;
out float lit;
void main() {
    // A third of a millimetre towards the camera, clear of the lid and the eye it lies between
    position = in_position + 0.0003 * normalize(camera.xyz - in_position);
    normal = in_normal;
    share = in_share;
    vec3 c = (shadow_from_world * vec4(in_position + 0.0025 * key_direction.xyz, 1.0)).xyz;
    lit = textureLod(shadow_map, c, 0.0);
    gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

// A concave water surface reflects every lamp in front of it somewhere: a thin bright line.
constexpr const char* kTear = R"(
in vec3 position;
in vec3 normal;
in float share;
in float lit;
out vec4 colour;
void main() {
    vec3 n = normalize(normal), v = normalize(camera.xyz - position);
    vec3 gloss = key_card.rgb * lit * min(2.2 * glint(n, v, key_direction.xyz, 0.36, 0.05), 1.0);
    gloss += fill_card.rgb * min(2.2 * glint(n, v, fill_direction.xyz, 0.36, 0.05), 1.0);
    gloss += mirrored_share(clamp(dot(n, v), 0.0, 1.0), 0.10, 0.03) * mirrored(reflect(-v, n), 0.0);
    // Straight through it one sees the lid and the eye, a little darker.
    colour = vec4(shown(gloss * share), 0.18 * share);
}
)";

}  // namespace

std::string tear_vertex_shader() { return frame_chunk() + kTearVertex; }
std::string tear_shader() { return frame_chunk() + lights_chunk() + kTear; }

}  // namespace risorius::render
