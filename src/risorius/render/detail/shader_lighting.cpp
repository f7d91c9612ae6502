// SPDX-License-Identifier: MIT
// GLSL shared by all materials: lights, shadow, tone and noise.
#include "risorius/render/detail/light.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kFrame = R"(#version 450 core
layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_world;
    vec4 mouth_centre, mouth_axis;
#ifndef LIGHTS_TOLD      // in front of this, see Lights::constants()
    mat4 shadow_from_world;
    vec4 shadow_places;
    vec4 camera;
    vec4 key_direction, key_card;
    vec4 fill_direction, fill_card;
    vec4 rim_direction, rim_card;
    vec4 irradiance[9];
#endif
};
)";

constexpr const char* kLights = R"(
layout(binding = 6) uniform sampler2DArray mirror_map;

// Scattering below the surface as a wider terminator, channel by channel: w is the distance light goes below the surface
// over the radius of curvature. The shares of the two powers keep what all directions together get.
vec3 scattered(float nl, vec3 w) {
    vec3 t = clamp((nl + w) / (1.0 + w), 0.0, 1.0);
    return t * mix(vec3(1.0), t, 3.0 * w / (1.0 + w));
}

// What a lamp that lights a white card with 1 sends off a glossy surface: GGX with the visibility term of Kelemen and
// Szirmay-Kalos 2001; includes the cosine at the surface.
float glint(vec3 n, vec3 v, vec3 l, float roughness, float f0) {
    vec3 h = normalize(v + l);
    float nl = clamp(dot(n, l), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), lh = clamp(dot(l, h), 0.0, 1.0);
    float a2 = roughness * roughness;
    a2 *= a2;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float m = 1.0 - lh, m2 = m * m;
    float fresnel = f0 + (1.0 - f0) * m2 * m2 * m;
    return nl * fresnel * a2 / (4.0 * d * d * max(lh * lh, 0.05));
}

// The key lamp is a soft box that subtends some 9 degrees: a lobe of the surface is so much wider, in squares of roughness.
const float kLampSize = 0.04;

// Two lobes of one lamp, each with its roughness and share.
float two_glints(vec3 n, vec3 v, vec3 l, vec2 roughness, vec2 share, float f0) {
    vec3 h = normalize(v + l);
    float nl = clamp(dot(n, l), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), lh = clamp(dot(l, h), 0.0, 1.0);
    vec2 a2 = roughness * roughness;
    a2 *= a2;
    vec2 d = nh * nh * (a2 - 1.0) + 1.0;
    float m = 1.0 - lh, m2 = m * m;
    float fresnel = f0 + (1.0 - f0) * m2 * m2 * m;
    return nl * fresnel * dot(share, a2 / (d * d)) / (4.0 * max(lh * lh, 0.05));
}

// Share of even light from all around that a glossy surface mirrors (fit by Karis 2014, Physically Based Shading on Mobile).
float mirrored_share(float nv, float roughness, float f0) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    return f0 * (r.z - 1.04 * a) + r.w + 1.04 * a;
}

// Of the surroundings: as a matt white surface shines, and as a mirror of a layer's roughness shows them.
vec3 ambient(vec3 n) {
    vec3 e = irradiance[0].rgb + irradiance[1].rgb * n.x + irradiance[2].rgb * n.y + irradiance[3].rgb * n.z;
    e += irradiance[4].rgb * (n.x * n.y) + irradiance[5].rgb * (n.y * n.z) + irradiance[6].rgb * (3.0 * n.z * n.z - 1.0);
    e += irradiance[7].rgb * (n.x * n.z) + irradiance[8].rgb * (n.x * n.x - n.y * n.y);
    return max(e, 0.0);
}
vec3 mirrored(vec3 towards, float layer) {
    vec2 at = vec2(atan(towards.x, towards.z) * 0.15915494 + 0.5, acos(clamp(towards.y, -1.0, 1.0)) * 0.31830989);
    return textureLod(mirror_map, vec3(at, layer), 0.0).rgb;
}

// Light over white is rolled off; below kStraightTo the picture is linear.
vec3 shown(vec3 x) {
    vec3 over = max(x - kStraightTo, 0.0) / (1.0 - kStraightTo);
    return min(x, kStraightTo) + (1.0 - kStraightTo) * over / (1.0 + over);
}
)";

constexpr const char* kShadow = R"(
layout(binding = 0) uniform sampler2DShadow shadow_map;

// Soft edge of the key light over a disc of 3.5 mm, wider below the chin: what shades neck and chest is the far jaw. The samples of a 2 x 2 block share the taps of one spiral (Vogel 1979)
// among them, every fourth each, and all get the mean. Not to be called where the block's samples go different ways.
// Each tap is as deep as the plane of the surface is there, so that slanted skin throws no shadow on itself. `further`: turn of
// the spiral.
float turned_visibility(vec3 p, vec3 n, float further) {
    float texel = shadow_places.y;
    vec3 c = (shadow_from_world * vec4(p + n * max(2.5 * texel, 0.0007), 1.0)).xyz;   // what throws it is coarse
    ivec2 q = ivec2(gl_FragCoord.xy) & 1;
    int first = q.x + 2 * q.y;
    vec2 e = first == 0 ? vec2(1.0, 0.0) : first == 1 ? vec2(-0.7374, 0.6755) : first == 2 ? vec2(0.0875, -0.9962) : vec2(0.6084, 0.7936);
    // Turned from block to block (by the sequence R2, Roberts 2018), or the steps of sixteen taps would show as terraces
    float turn = 6.2832 * fract(dot(vec2(ivec2(gl_FragCoord.xy) >> 1), vec2(0.7548777, 0.5698403))) + further;
    e = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * e;
    float below = clamp(mouth_centre.y - p.y - 0.06, 0.0, 0.1);
    e *= (0.0035 + 0.12 * below) / (texel * shadow_places.x);
    vec2 f = vec2(-e.y, e.x);
    vec2 slope = (mat3(shadow_from_world) * n).xy * (0.5 * texel * shadow_places.x) / max(dot(n, key_direction.xyz), 0.2);
    vec4 r = sqrt((vec4(0.5, 4.5, 8.5, 12.5) + float(first)) * 0.0625);
    vec4 lit;
    vec2 a = r.x * e, b = r.y * (-0.9847 * e - 0.1743 * f), g = r.z * (0.9392 * e + 0.3433 * f), h = r.w * (-0.8650 * e - 0.5018 * f);
    lit.x = textureLod(shadow_map, vec3(c.xy + a, c.z + dot(slope, a)), 0.0);
    lit.y = textureLod(shadow_map, vec3(c.xy + b, c.z + dot(slope, b)), 0.0);
    lit.z = textureLod(shadow_map, vec3(c.xy + g, c.z + dot(slope, g)), 0.0);
    lit.w = textureLod(shadow_map, vec3(c.xy + h, c.z + dot(slope, h)), 0.0);
    float s = dot(lit, vec4(0.25));
    s += (0.5 - float(q.x)) * dFdxFine(s);
    return s + (0.5 - float(q.y)) * dFdyFine(s);
}
float key_visibility(vec3 p, vec3 n) { return turned_visibility(p, n, 0.0); }

// With four spirals, for teeth and gums: they are bright, have few pixels, and the edge of the lip's shadow lies on them.
float fine_visibility(vec3 p, vec3 n) {
    float s = 0.0;
    for (int k = 0; k < 4; ++k) s += turned_visibility(p, n, 1.5708 * 0.618 * float(k));
    return 0.25 * s;
}
)";

constexpr const char* kNoise = R"(
float hash(vec3 p) {
    uvec3 q = uvec3(ivec3(p)) * uvec3(1597334673u, 3812015801u, 2798796415u);
    uint n = (q.x ^ q.y ^ q.z) * 1597334673u;
    return float(n >> 8) * (1.0 / 16777216.0);
}
float noise(vec3 p) {
    vec3 i = floor(p), f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    vec2 e = vec2(0.0, 1.0);
    return mix(mix(mix(hash(i), hash(i + e.yxx), f.x), mix(hash(i + e.xyx), hash(i + e.yyx), f.x), f.y),
               mix(mix(hash(i + e.xxy), hash(i + e.yxy), f.x), mix(hash(i + e.xyy), hash(i + e.yyy), f.x), f.y), f.z);
}
)";

// Inputs of the wrinkles of the skin, see shader_skin.cpp
constexpr const char* kFoldsVertex = R"(
layout(location = 5) in vec3 in_fold_phase;
layout(location = 6) in vec3 in_fold_depth;
out vec3 fold_phase;
out vec3 fold_depth;
void pass_folds() {
    fold_phase = in_fold_phase;
    fold_depth = in_fold_depth;
}
)";
constexpr const char* kNoFoldsVertex = "void pass_folds() {}\n";

// Light of the key lamp per vertex, for drafts.
constexpr const char* kKeyVertex = R"(
out vec3 key_light;    // of a white surface
out float key_gloss;   // and what of a lamp of 1 it mirrors
out vec3 lit_at;       // in the shadow map
void pass_key(vec3 p, vec3 n, vec3 v, vec3 w, float kept) {
    key_light = kept * key_card.rgb * scattered(dot(n, key_direction.xyz), w);
    key_gloss = two_glints(n, v, key_direction.xyz, sqrt(vec2(0.2153, 0.0676) + kLampSize), vec2(0.76, 0.24), 0.028);
    lit_at = (shadow_from_world * vec4(p + n * (2.5 * shadow_places.y), 1.0)).xyz;
}
)";
constexpr const char* kNoKeyVertex =
    "void pass_key(vec3 p, vec3 n, vec3 v, vec3 w, float kept) {}\n";

constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_rest;
layout(location = 3) in vec2 in_paint;
layout(location = 4) in vec4 in_occlusion;
out vec3 position;
out vec3 normal;
out vec3 rest;
out vec2 paint;
out float sky_seen;
out float curvature;      // 1/m
out vec3 soft;            // what fill, rim and surroundings light of a white surface
out vec3 soft_gloss;      // and what of them it mirrors
out float kept;           // of a lamp's light, not mirrored
out float pores;          // how much the skin shows of them
uniform bool inside_mouth;
uniform vec3 scatter;     // m
uniform vec3 bounce;      // albedo hereabouts
uniform vec4 finish;      // roughness, reflectance straight on, share of it, layer of the mirror

const vec3 kThroughLips = vec3(0.30, 0.055, 0.045);
const vec3 kFromWalls = vec3(1.90, 1.45, 1.40);   // light deep in the mouth, over that which comes straight in

// From the nearest point of the line of the mouth, of which `share` counts.
vec3 from_lips(vec3 p, float share) {
    vec3 d = p - mouth_centre.xyz, a = mouth_axis.xyz;
    return d - a * clamp(dot(d, a) / max(dot(a, a), 1e-9), -share, share);
}

// Share of what comes through the open lips that reaches a point behind them: the gap seen as a disc at the distance of
// the nearest point of its long axis.
float seen_through_lips(vec3 p) {
    vec3 d = from_lips(p, 0.75);
    float share = mouth_centre.w / (mouth_centre.w + 3.1416 * dot(d, d) + 1e-9);
    return share;
}

void main() {
    position = in_position;
    normal = in_normal;
    rest = in_rest;
    paint = in_paint;
    pass_folds();
    float inside = inside_mouth ? 1.0 : in_occlusion.y;
    sky_seen = mix(in_occlusion.x, seen_through_lips(in_position), inside);
    // Light from behind the head never comes in through the lips.
    float behind_seen = (1.0 - inside) * in_occlusion.x;
    curvature = in_occlusion.z;
    pores = in_occlusion.w;

    vec3 v = normalize(camera.xyz - in_position);
    vec3 n = inside_mouth ? faceforward(in_normal, -v, in_normal) : in_normal;
    vec3 w = min(scatter * curvature, 0.5);
    // Light that has met the skin before comes back in its colour (Jimenez 2016, Practical Realtime Strategies for Accurate
    // Indirect Occlusion).
    vec3 open = max(vec3(sky_seen), ((sky_seen * (2.0404 * bounce - 0.3324) + (0.6417 - 4.7951 * bounce)) * sky_seen +
                                     (2.7552 * bounce + 0.6903)) * sky_seen);
    // Walls, palate and cheeks pass light on to one another, red light most.
    open *= mix(vec3(1.0), mix(kFromWalls, vec3(1.0), sky_seen), inside);
    // Lips let red light through: the line between them is not black. Where they are shut, it also comes from the skin around.
    vec3 behind = from_lips(in_position, 1.0);
    behind.z *= 0.65;   // the corners lie back
    float apart = dot(behind, behind);
    float shut = smoothstep(1.2e-4, 0.0, mouth_centre.w);
    open += inside * kThroughLips * (exp(-apart * 1.6e4) + shut * 1.1 * (0.1 + min(2.0 * bounce.r, 1.0)) * exp(-apart * 8e3));
    soft = open * (fill_card.rgb * scattered(dot(n, fill_direction.xyz), w) + ambient(n));
    soft += behind_seen * rim_card.rgb * scattered(dot(n, rim_direction.xyz), w);
    float nv = clamp(dot(n, v), 0.0, 1.0);
    float share = finish.z * mirrored_share(nv, finish.x, finish.y);
    kept = 1.0 - share;
    soft *= kept;
    soft_gloss = sky_seen * sky_seen * (share * mirrored(reflect(-v, n), finish.w) +
                 finish.z * fill_card.rgb * glint(n, v, fill_direction.xyz, finish.x, finish.y));
    soft_gloss += finish.z * behind_seen * behind_seen * rim_card.rgb * glint(n, v, rim_direction.xyz, finish.x, finish.y);
    pass_key(in_position, n, v, w, kept);
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kDepthVertex = R"(#version 450 core
layout(location = 0) in vec3 in_position;
uniform mat4 clip_from_world;
void main() { gl_Position = clip_from_world * vec4(in_position, 1.0); }
)";

}  // namespace

std::string turns_chunk() { return "const float kTurnsPerMetre = 1.0 / 0.256;\n"; }
std::string frame_chunk() { return kFrame; }
std::string lights_chunk() {
    return "const float kStraightTo = " + std::to_string(kStraightTo) + ";\n" + kLights;
}
std::string lighting_chunk() { return std::string(kFrame) + lights_chunk() + kShadow; }
std::string noise_chunk() { return kNoise; }
std::string surface_vertex_shader(bool folds, bool key) {
    return std::string(kFrame) + lights_chunk() + (folds ? kFoldsVertex : kNoFoldsVertex) +
           (key ? kKeyVertex : kNoKeyVertex) + kSurfaceVertex;
}
std::string depth_vertex_shader() { return kDepthVertex; }

}  // namespace risorius::render
