// SPDX-License-Identifier: MIT
// GLSL of skin that was shaded separately, once per pixel: see skin_layer.h.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kLookupVertex = R"(
layout(location = 0) in vec3 in_position;
uniform float beyond;  // m that are added to the distance, see shader_lock.cpp
out float away;       // m from the camera
void main() {
    away = distance(camera.xyz, in_position) + beyond;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

// The alpha of the layer is the distance from the camera, which wraps around every 256 mm, or 0 where there is no skin.
constexpr const char* kLookup = R"(#version 450 core
layout(binding = 7) uniform usampler2D skin_layer;
uniform float shaded_per_sample;
in float away;
out uint colour;      // all four bytes: they are copied, and four numbers would be converted there and back

// Between a shaded place and the sample, m; beyond all where nothing was shaded.
float apart(uint shaded) {
    float turn = fract(away * kTurnsPerMetre - float(shaded >> 24) * (1.0 / 256.0) + 0.5) - 0.5;
    return shaded < 0x01000000u ? 1.0 : abs(turn) / kTurnsPerMetre;
}

void main() {
    vec2 place = gl_FragCoord.xy * shaded_per_sample;
    ivec2 at = ivec2(place);
    uint own = texelFetch(skin_layer, at, 0).r;
    // As far as a slope takes it within a pixel, and rounding of the distance to bytes
    float far = (abs(dFdx(away)) + abs(dFdy(away))) / shaded_per_sample + 0.003;
    float nearest = apart(own);
    // Nearly all samples leave the loop before it begins.
    int neighbours = nearest > far ? 8 : 0;
    ivec2 towards = ivec2(fract(place.x) < 0.5 ? -1 : 1, fract(place.y) < 0.5 ? -1 : 1);
    for (int i = 0; i < neighbours; ++i) {
        ivec2 side = i == 0 ? ivec2(1, 0) : i == 1 ? ivec2(0, 1) : i == 2 ? ivec2(1, 1) : i == 3 ? ivec2(-1, 1) : i == 4 ? ivec2(1, -1) : i == 5 ? ivec2(-1, 0) : i == 6 ? ivec2(0, -1) : ivec2(-1, -1);
        uint other = texelFetch(skin_layer, clamp(at + side * towards, ivec2(0), textureSize(skin_layer, 0) - 1), 0).r;
        float d = apart(other);
        if (d < nearest - 0.001) {
            own = other;
            nearest = d;
        }
        // The nearest in the picture that will do
        if (nearest <= far) break;
    }
    colour = own < 0x01000000u ? 0u : own | 0xff000000u;
}
)";

// The same result as glClear.
constexpr const char* kClearVertex = R"(#version 450 core
layout(location = 0) in vec2 in_place;
void main() { gl_Position = vec4(in_place, 1.0, 1.0); }
)";
constexpr const char* kClear = R"(#version 450 core
out uint colour;
void main() { colour = 0u; }
)";

}  // namespace

std::string clear_vertex_shader() { return kClearVertex; }
std::string clear_shader() { return kClear; }
std::string lookup_vertex_shader() { return frame_chunk() + kLookupVertex; }
std::string lookup_shader() {
    std::string source = kLookup;
    const std::string version = "#version 450 core\n";
    return source.insert(version.size(), turns_chunk());
}

}  // namespace risorius::render
