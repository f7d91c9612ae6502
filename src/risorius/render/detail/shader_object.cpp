// SPDX-License-Identifier: MIT
// GLSL of ObjectView: transparent two-sided surface, flat wires, balls; the light is fixed to the camera.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec2 in_place;
layout(location = 4) in float in_kind;
out vec3 normal;
out vec3 albedo;
out vec2 place;
flat out float kind;
uniform mat4 clip_from_world;
void main() {
    normal = in_normal;
    albedo = in_colour;
    place = in_place;
    kind = in_kind;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kFragment = R"(#version 450 core
in vec3 normal;
in vec3 albedo;
in vec2 place;
flat in float kind;
out vec4 colour;

// Camera axes: the key light over the left shoulder, a weaker one from the right.
const vec3 key = vec3(-0.43, 0.65, 0.63);
const vec3 fill = vec3(0.81, 0.10, 0.58);

vec3 lit(vec3 n) {
    float diffuse = 0.34 + 0.62 * max(dot(n, key), 0.0) + 0.16 * max(dot(n, fill), 0.0);
    float gloss = pow(max(dot(n, normalize(key + vec3(0.0, 0.0, 1.0))), 0.0), 48.0);
    return albedo * diffuse + 0.12 * gloss;
}

void main() {
    if (kind > 1.5) {
        float d = dot(place, place);
        if (d > 1.0) discard;
        colour = vec4(lit(vec3(place, sqrt(1.0 - d))), 1.0);
    } else if (kind > 0.5) {
        colour = vec4(albedo, 1.0);
    } else {
        // Both sides are looked at; a surface seen at a slant is more of it, so more opaque.
        vec3 n = normalize(normal.z < 0.0 ? -normal : normal);
        float slant = 1.0 - n.z;
        colour = vec4(lit(n), 0.42 + 0.40 * slant * slant);
    }
}
)";

}  // namespace

std::string object_vertex_shader() { return kVertex; }
std::string object_shader() { return kFragment; }

}  // namespace risorius::render
