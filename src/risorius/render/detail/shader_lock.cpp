// SPDX-License-Identifier: MIT
// GLSL of locks of hair: light from all around, and two highlights across the hairs.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

// Kajiya and Kay 1989; the two highlights, one white and one of the hair's tone, as Scheuermann 2004, Practical Real-Time Hair
// Rendering and Shading. Everything but the strands is computed per vertex of a lock.
constexpr const char* kLockVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_along;
layout(location = 2) in vec3 in_out;
layout(location = 3) in vec2 in_strand;
layout(location = 4) in vec3 in_light;     // share of the light, factor of the tone, added share of white hairs
layout(location = 5) in vec2 in_thin;      // place across the lock, -1..1; 0..1, how thin the hair is along it
layout(binding = 0) uniform sampler2DShadow shadow_map;
uniform vec3 hair_tone;                    // linear
uniform vec3 white_tone;
uniform float own_shadow;                  // m
uniform float mirrors;                     // factor of the highlights
out vec3 dark;       // what hairs of the tone, and white ones, send to the camera
out vec3 white;
out vec3 shine;
out vec2 strand;
out float grey;
out vec2 thin;
out vec3 position;

float highlight(vec3 t, vec3 h, float power) {
    float th = dot(t, h);
    return pow(max(1.0 - th * th, 0.0), 0.5 * power);
}

void main() {
    vec3 v = normalize(camera.xyz - in_position), k = key_direction.xyz, n = in_out;
    vec3 t = normalize(in_along);
    // Own shadow, from what lies some millimetres nearer to the lamp
    vec3 c = (shadow_from_world * vec4(in_position + own_shadow * k + 0.5 * own_shadow * n, 1.0)).xyz;
    float s = textureLod(shadow_map, c, 0.0);
    float nk = dot(n, k), tk = dot(t, k);
    float form = smoothstep(-0.35, 0.75, nk);
    float around = sqrt(max(1.0 - tk * tk, 0.0)) * form;
    vec3 rim = rim_card.rgb * smoothstep(-0.1, 0.7, dot(n, rim_direction.xyz));
    vec3 even = 0.6 * fill_card.rgb * clamp(0.5 + 0.5 * dot(n, fill_direction.xyz), 0.0, 1.0) + ambient(n);
    vec3 light = in_light.x * (key_card.rgb * (s * around) + even + 0.5 * rim);
    vec3 h = normalize(v + k), back = normalize(v + rim_direction.xyz);
    vec3 first = normalize(t - 0.10 * n), second = normalize(t + 0.12 * n);
    float lamp = mirrors * s * form * in_light.x;
    vec3 tone = hair_tone * in_light.y;
    dark = tone * light;
    white = white_tone * light;
    vec3 gloss = key_card.rgb * (lamp * highlight(second, h, 18.0)) + 0.35 * rim * highlight(t, back, 18.0);
    shine = gloss * (0.85 * tone + 0.020) + key_card.rgb * (0.07 * lamp * highlight(first, h, 60.0)) + 0.009 * light;
    grey = in_light.z;
    thin = in_thin;
    position = in_position;
    strand = in_strand;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kLockFragment = R"(
in vec3 dark;
in vec3 white;
in vec3 shine;
in vec2 strand;
in float grey;
in vec2 thin;
out vec4 colour;
layout(binding = 11) uniform sampler2D strand_map;
uniform bool has_white;
// At its sides and its tip a lock is single hairs: strands of the same texture, half as coarse again, so that they are seen.
void cut() {
    if (!has_gaps) return;
    float side = abs(thin.x);
    float bare = max(0.50 * smoothstep(0.40, 1.0, side), thin.y);
    if (bare < 0.15) return;
    float strands = texture(strand_map, strand * vec2(0.75, 0.5) + 0.3).r;
    if (0.5 + 2.4 * (strands - 0.46) < 0.98 * bare) discard;
}

void main() {
    cut();
    vec2 hairs = texture(strand_map, strand).rg;
    float bright = hairs.r + hairs.r * hairs.r;      // gaps between strands are dark
    vec3 own = dark;
    if (has_white) {
        // Dark hairs swallow light that white ones beside them scatter: a quarter of white hairs looks dark, not silver.
        vec3 root = mix(sqrt(dark), sqrt(white), min(hairs.g * (1.0 + grey), 1.0));
        own = root * root;
    }
    colour = vec4(shown(own * (0.60 + 0.60 * bright) + shine * (0.2 + 0.7 * bright)), told());
}
)";

// What the layer is told of hair is farther by half a turn, so that hair never seems to lie on the skin: locks that lie on each other
// then need samples only at larger steps.
constexpr const char* kHairAway = R"(
float told() {
    return max(fract((distance(camera.xyz, position) + kHairBeyond) * kTurnsPerMetre) * (256.0 / 255.0), 1.0 / 255.0);
}
)";
std::string told_of_hair(bool layer) {
    if (!layer) return told_chunk(false);
    return turns_chunk() + "const float kHairBeyond = " + std::to_string(kHairBeyond_m) + ";\n" +
           kHairAway;
}

}  // namespace

std::string lock_vertex_shader() { return frame_chunk() + lights_chunk() + kLockVertex; }
std::string lock_shader(bool layer, bool gaps) {
    return frame_chunk() + lights_chunk() +
           "in vec3 position;\nconst bool has_gaps = " + (gaps ? "true;\n" : "false;\n") +
           told_of_hair(layer) + kLockFragment;
}

}  // namespace risorius::render
