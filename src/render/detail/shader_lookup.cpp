// GLSL of skin that was shaded elsewhere, once per pixel: see skin_layer.h.
#include "render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kLookupVertex = R"(
layout(location = 0) in vec3 in_position;
out float away;       // m from the camera
void main() {
    away = distance(camera.xyz, in_position);
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

// Alpha of the layer is the distance from the camera, turning once every 256 mm, or 0 where there is no skin.
constexpr const char* kLookup = R"(#version 450 core
layout(binding = 7) uniform sampler2D skin_layer;
uniform float shaded_per_sample;
in float away;
out vec4 colour;

// Between a shaded place and the sample, m; beyond all where nothing was shaded.
float apart(vec4 shaded) {
    float turn = fract(away * kTurnsPerMetre - shaded.a * (255.0 / 256.0) + 0.5) - 0.5;
    return shaded.a == 0.0 ? 1.0 : abs(turn) / kTurnsPerMetre;
}

void main() {
    vec2 place = gl_FragCoord.xy * shaded_per_sample;
    ivec2 at = ivec2(place);
    vec4 own = texelFetch(skin_layer, at, 0);
    // As far as a slope takes it within a pixel, and rounding of the distance to bytes
    float far = (abs(dFdx(away)) + abs(dFdy(away))) / shaded_per_sample + 0.003;
    float nearest = apart(own);
    // Nearly all samples leave the loop before it begins.
    int neighbours = nearest > far ? 8 : 0;
    ivec2 towards = ivec2(fract(place.x) < 0.5 ? -1 : 1, fract(place.y) < 0.5 ? -1 : 1);
    for (int i = 0; i < neighbours; ++i) {
        ivec2 side = i == 0 ? ivec2(1, 0) : i == 1 ? ivec2(0, 1) : i == 2 ? ivec2(1, 1) : i == 3 ? ivec2(-1, 1) : i == 4 ? ivec2(1, -1) : i == 5 ? ivec2(-1, 0) : i == 6 ? ivec2(0, -1) : ivec2(-1, -1);
        vec4 other = texelFetch(skin_layer, clamp(at + side * towards, ivec2(0), textureSize(skin_layer, 0) - 1), 0);
        float d = apart(other);
        if (d < nearest - 0.001) {
            own = other;
            nearest = d;
        }
        // The nearest in the picture that will do
        if (nearest <= far) break;
    }
    colour = vec4(own.rgb, own.a > 0.0 ? 1.0 : 0.0);
}
)";

// As glClear would do it
constexpr const char* kClearVertex = R"(#version 450 core
layout(location = 0) in vec2 in_place;
void main() { gl_Position = vec4(in_place, 1.0, 1.0); }
)";
constexpr const char* kClear = R"(#version 450 core
out vec4 colour;
void main() { colour = vec4(0.0); }
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
