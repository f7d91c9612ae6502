// SPDX-License-Identifier: MIT
// GLSL of the bowl around an eyeball: moist flesh in the dark.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kSocketVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in float in_open;
out vec3 soft;
void main() {
    soft = in_open * (fill_card.rgb * max(dot(in_normal, fill_direction.xyz), 0.0) + ambient(in_normal));
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

// Little light enters between lid and eye, and what returns has been reflected by flesh.
constexpr const char* kSocket = R"(
in vec3 soft;
out vec4 colour;
void main() { colour = vec4(shown(vec3(0.105, 0.030, 0.024) * soft), 1.0); }
)";

}  // namespace

std::string socket_vertex_shader() { return frame_chunk() + lights_chunk() + kSocketVertex; }
std::string socket_shader() { return frame_chunk() + lights_chunk() + kSocket; }

}  // namespace risorius::render
