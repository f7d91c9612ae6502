// SPDX-License-Identifier: MIT
// GLSL of skin coloured by a quantity. The light is even, so that colours can be read off their scale, with just enough shading
// to recognize the place on the face.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kValuesVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 4) in vec2 in_occlusion;
layout(location = 7) in vec3 in_colour;
out vec3 position;
out vec3 normal;
out vec3 value;
out float open;
void main() {
    position = in_position;
    normal = in_normal;
    value = in_colour;
    open = in_occlusion.x * (1.0 - 0.7 * in_occlusion.y);
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kValuesFragment = R"(
in vec3 position;
in vec3 normal;
in vec3 value;
in float open;
out vec4 colour;

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float light = 0.5 + 0.5 * dot(n, key_direction.xyz);
    float shade = (0.55 + 0.45 * smoothstep(0.05, 0.75, facing)) * (0.62 + 0.38 * smoothstep(0.15, 0.90, light));
    colour = vec4(value * shade * (0.70 + 0.30 * smoothstep(0.1, 0.7, open)), 1.0);
}
)";

}  // namespace

std::string values_vertex_shader() { return frame_chunk() + kValuesVertex; }
std::string values_shader() { return frame_chunk() + kValuesFragment; }

}  // namespace risorius::render
