// SPDX-License-Identifier: MIT
// GLSL of colours from the mesh's own textures, and of the drawing of such textures.
#include "risorius/render/detail/shader_paint.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kOwnColour = R"(
layout(binding = 8) uniform sampler2D own_colour_map;     // sRGB, decoded by the sampler
layout(binding = 9) uniform samplerBuffer own_places;     // two per triangle: u and v as functions of the rest position
const bool kOwn = true;
vec3 own_colour(vec3 at, vec3 generated) {
    vec4 p = vec4(at, 1.0);
    vec2 place = vec2(dot(texelFetch(own_places, 2 * gl_PrimitiveID), p), dot(texelFetch(own_places, 2 * gl_PrimitiveID + 1), p));
    return texture(own_colour_map, place).rgb;
}
)";
constexpr const char* kGeneratedColour = R"(
const bool kOwn = false;
vec3 own_colour(vec3 at, vec3 generated) { return generated; }
)";

constexpr const char* kOwnSkinVertex = R"(#version 450 core
layout(location = 0) in vec3 in_place;     // on the map, and depth
layout(location = 1) in vec2 in_texcoord;
out vec2 texcoord;
void main() {
    texcoord = in_texcoord;
    gl_Position = vec4(2.0 * in_place.xy - 1.0, in_place.z, 1.0);
}
)";
constexpr const char* kOwnSkin = R"(#version 450 core
in vec2 texcoord;
out vec4 colour;
layout(binding = 8) uniform sampler2D own_colour_map;
void main() { colour = vec4(sqrt(texture(own_colour_map, texcoord).rgb), 1.0); }
)";

constexpr const char* kPartTextureVertex = R"(#version 450 core
layout(location = 0) in vec2 in_texcoord;
layout(location = 1) in vec3 in_rest;
layout(location = 2) in vec3 in_normal;
layout(location = 3) in float in_crown_height;
out vec3 rest;
out vec3 normal;
out float crown_height;
void main() {
    rest = in_rest;
    normal = in_normal;
    crown_height = in_crown_height;
    gl_Position = vec4(2.0 * in_texcoord - 1.0, 0.0, 1.0);
}
)";
constexpr const char* kTextureInputs = R"(#version 450 core
in vec3 rest;
in vec3 normal;
in float crown_height;
out vec4 colour;
)";

}  // namespace

std::string own_colour_chunk(bool own) { return own ? kOwnColour : kGeneratedColour; }
std::string own_skin_vertex_shader() { return kOwnSkinVertex; }
std::string own_skin_shader() { return kOwnSkin; }
std::string part_texture_vertex_shader() { return kPartTextureVertex; }
std::string texture_inputs_chunk() { return kTextureInputs; }

}  // namespace risorius::render
