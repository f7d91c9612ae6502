// SPDX-License-Identifier: MIT
// GLSL of muscles seen through the skin: the colour of their activation, bundles of fibres, pale tendons.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kMuscleVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec3 in_fibre;    // along, across, m; share of tendon
out vec3 position;
out vec3 normal;
out vec3 flesh;
out vec3 fibre;
void main() {
    position = in_position;
    normal = in_normal;
    flesh = in_colour;
    fibre = in_fibre;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kMuscleFragment = R"(
in vec3 position;
in vec3 normal;
in vec3 flesh;
in vec3 fibre;
out vec4 colour;

const vec3 kTendon = vec3(0.54, 0.52, 0.47);

layout(binding = 5) uniform sampler2D fibre_map;    // see make_fibres()
uniform vec2 fibre_tile;                            // m, across and along

void main() {
    vec3 n = normalize(normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 k = key_direction.xyz, f = fill_direction.xyz;

    // Bundles stand out as ridges, and fray into the tendon.
    vec3 bundle = texture(fibre_map, fibre.yx / fibre_tile).rgb;
    float streak = bundle.r, strand = bundle.b;
    vec3 across = dFdx(position) * dFdx(fibre.y) + dFdy(position) * dFdy(fibre.y);
    n = normalize(n - 1.6 * (bundle.g - 0.5) * across / (length(across) + 1e-12));
    float tendon = smoothstep(0.25, 0.75, fibre.z + 0.5 * (streak - 0.5)) * 0.75;
    vec3 albedo = mix(flesh * (0.62 + 0.76 * streak), kTendon * (0.85 + 0.3 * strand), tendon);

    // Even light, so that the colour can be read off the scale; edges turn dark, which parts neighbours.
    vec3 kd = vec3(clamp(dot(n, k) * 0.85 + 0.15, 0.0, 1.0)), fd = vec3(clamp(dot(n, f) * 0.7 + 0.3, 0.0, 1.0));
    vec3 light = 0.60 * kd * key_card.rgb + fd * fill_card.rgb * 0.5 + ambient(n) * 0.5;
    float facing = clamp(dot(normalize(normal), v), 0.0, 1.0);
    light *= 0.30 + 0.70 * smoothstep(0.0, 0.60, facing);
    float gloss = glint(n, v, k, 0.42, 0.035) * key_card.r * (0.5 + strand);
    colour = vec4(clamp(albedo * light + 1.2 * gloss, 0.0, 1.0), 1.0);
}
)";

}  // namespace

std::string muscle_vertex_shader() { return frame_chunk() + kMuscleVertex; }
std::string muscle_shader() { return lighting_chunk() + kMuscleFragment; }

}  // namespace risorius::render
