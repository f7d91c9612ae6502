// SPDX-License-Identifier: MIT
#include "risorius/render/detail/shader_paint.h"

#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kPaintVertex = R"(#version 450 core
layout(location = 2) in vec3 in_rest;
layout(location = 3) in vec2 in_paint;
out vec3 rest;
out vec2 place;
out vec4 zone_sum;         // log of tint, added oil: smooth enough to be interpolated
uniform vec3 centre;
uniform int zones;
uniform vec4 zone_place[48];
uniform vec4 zone_tint[48];
void main() {
    rest = in_rest;
    place = in_paint;
    zone_sum = vec4(0.0);
    for (int i = 0; i < zones; ++i) {
        vec3 d = in_rest - zone_place[i].xyz;
        zone_sum += exp(-dot(d, d) * zone_place[i].w) * zone_tint[i];
    }
    // The farther out, the nearer: what the surface hides under its folds is not painted.
    gl_Position = vec4(2.0 * in_paint - 1.0, 1.0 - 2.0 * min(length(in_rest - centre) / 0.5, 1.0), 1.0);
}
)";

constexpr const char* kPaint = R"(
in vec3 rest;
in vec2 place;
in vec4 zone_sum;
out vec4 colour;
uniform vec3 skin_tone, lip_tone, hair_tone;   // linear
uniform float scalp_hair, seed, age, mottling, beard, white_beard, trimmed;
uniform float ring;             // the crown is bald above it, m
uniform vec2 hair_begins;       // distances outside the hairline where its tone begins and is full, of the map
uniform vec4 beard_place[16];   // m, 1 / (2 spread^2)
uniform int beard_places;
uniform int lip_points;
uniform vec2 lip_outline[96];
uniform vec4 lip_box;
uniform float lip_back;
uniform float hairline[32];
uniform vec4 ear_low[2], ear_high[2];   // box; w: |x| of its inner plane, and how that leans back

// Signed distance to the closed outline of the lips, negative inside, m.
float outside_lips(vec2 p) {
    float nearest = 1.0;
    bool inside = false;
    for (int i = 0; i < lip_points; ++i) {
        vec2 a = lip_outline[i], b = lip_outline[i + 1 < lip_points ? i + 1 : 0];
        vec2 e = b - a, w = p - a;
        vec2 d = w - e * clamp(dot(w, e) / max(dot(e, e), 1e-12), 0.0, 1.0);
        nearest = min(nearest, dot(d, d));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + e.x * (p.y - a.y) / e.y) inside = !inside;
    }
    return inside ? -sqrt(nearest) : sqrt(nearest);
}

float hair_start(vec2 d) {
    float turn = atan(d.x, d.y) / 6.2831853;
    float at = fract(turn) * 32.0;
    int i = int(at) % 32;
    return mix(hairline[i], hairline[(i + 1) % 32], fract(at));
}

void main() {
    vec3 p = rest * 1000.0 + 500.0 + seed;   // mm, positive for the noise
    vec3 tint = zone_sum.rgb;
    float oil = 0.32 + zone_sum.a;
    // Mottling: patches of blood a centimetre wide, of pigment a few millimetres wide, and grain
    float blood = noise(p * 0.11) + 0.6 * noise(p * 0.27 + 9.0) - 0.8;
    float pigment = noise(p * 0.55 + 70.0) + 0.7 * noise(p * 1.3 + 30.0) - 0.85;
    float grain = noise(p * 3.1) - 0.5;
    // Pigment gathers in spots with the years, and the blood shows less.
    tint *= 1.0 - 0.35 * age;
    float spots = smoothstep(0.30, 0.75, noise(p * 0.16 + 200.0) + 0.5 * noise(p * 0.6 + 140.0) - 0.35);
    tint += age * vec3(-0.05, -0.085, -0.12) * spots + age * vec3(0.0, -0.02, -0.05);
    // A few are well bounded, some millimetres wide.
    float spot = smoothstep(0.84, 0.94, noise(p * 0.21 + 310.0) + 0.25 * (noise(p * 0.9 + 17.0) - 0.5)) * smoothstep(0.35, 0.65, noise(p * 0.035 + 55.0));
    tint += age * age * vec3(-0.12, -0.20, -0.27) * spot;
    pigment *= 1.0 + 1.2 * age;
    oil *= 1.0 - 0.35 * age;
    tint += blood * vec3(0.00, -0.060, -0.045) + pigment * vec3(-0.030, -0.040, -0.050) + grain * 0.05;
    // Sun and years leave the colour uneven: patches of one and of half a centimetre, and grain
    float uneven = noise(p * 0.17 + 410.0) + noise(p * 0.42 + 430.0) - 1.0;
    float fine = noise(p * 1.1 + 450.0) - 0.5;     // of pores and grain
    float dark = clamp((0.30 - dot(skin_tone, vec3(0.2126, 0.7152, 0.0722))) / 0.25, 0.0, 1.0);   // gloss hides the colour
    tint += (1.0 + 0.7 * dark) * mottling * (uneven * vec3(-0.13, -0.20, -0.23) + fine * vec3(-0.12, -0.16, -0.18) + grain * 0.10);
    vec3 albedo = skin_tone * exp(tint);

    vec2 from_middle = place - 0.5;
    float r = length(from_middle);
    float hair = smoothstep(hair_begins.x, hair_begins.y, r - hair_start(from_middle) + 0.016 * (noise(p * 0.30 + 3.0) - 0.5) + 0.008 * (noise(p * 0.9 + 33.0) - 0.5));
    hair *= 1.0 - smoothstep(-0.008, 0.006, rest.y + 0.20 * rest.z - ring + 0.010 * (noise(p * 0.5 + 21.0) - 0.5));
    float before_ears = 1.0;
    for (int i = 0; i < 2; ++i) {
        if (any(lessThan(rest, ear_low[i].xyz)) || any(greaterThan(rest, ear_high[i].xyz))) continue;
        vec3 from_top = ear_high[i].xyz - rest;
        float out_of = abs(rest.x) - ear_low[i].w - ear_high[i].w * (from_top.z + max(0.0, rest.y));
        float bowl = smoothstep(0.010, 0.020, from_top.y) * smoothstep(0.034, 0.028, from_top.z) * smoothstep(0.0, 0.005, from_top.z);
        hair *= smoothstep(0.002, -0.001, out_of) * (1.0 - bowl);
        before_ears *= smoothstep(0.004, 0.0, from_top.z);
    }
    vec3 under_hair = mix(albedo, hair_tone, 0.88) * vec3(0.88, 0.90, 0.93);
    albedo = mix(albedo, under_hair, hair * scalp_hair);
    float matte = smoothstep(-0.045, 0.010, r - hair_start(from_middle));
    if (ring < 100.0) matte = hair;
    oil *= 1.0 - (0.55 * matte + 0.43 * hair) * min(1.0, 1.7 * scalp_hair);

    // Hair that is cut at the skin still darkens it, white hair hardly.
    float shadow = 0.0;
    for (int i = 0; i < beard_places; ++i) {
        vec3 d = rest - beard_place[i].xyz;
        shadow += exp(-dot(d, d) * beard_place[i].w);
    }
    shadow = beard * before_ears * smoothstep(0.25, 0.85, shadow + 0.25 * (noise(p * 0.5 + 11.0) - 0.5));
    vec3 roots = albedo * mix(vec3(0.62, 0.66, 0.72), vec3(0.92, 0.94, 0.97), white_beard);
    albedo = mix(albedo, mix(roots, hair_tone, (0.35 + 0.35 * trimmed) * (1.0 - 0.6 * white_beard)), (0.55 + 0.25 * trimmed) * shadow);
    oil *= 1.0 - 0.4 * shadow;

    bool near_lips = lip_points > 0 && all(greaterThan(rest.xy, lip_box.xy)) && all(lessThan(rest.xy, lip_box.zw)) && rest.z > lip_back;
    if (near_lips) {
        float d = outside_lips(rest.xy) + 0.0006 * (noise(p * 0.9) - 0.5);
        float lip = smoothstep(0.0008, -0.0016, d);
        float fold = noise(vec3(p.x * 1.1, p.y * 0.22, p.z * 0.22)) - 0.5;
        float rim = exp(-d * d / 1.4e-6);      // the pale roll of the border
        vec3 red = mix(lip_tone, skin_tone, 0.45 * age) * (1.0 + 0.16 * fold) * mix(vec3(1.10, 1.16, 1.16), vec3(0.94, 0.84, 0.84), smoothstep(-0.0005, -0.006, d));
        red *= exp(min(zone_sum.rgb + vec3(0.05, 0.10, 0.10), 0.0));   // what is in the shade of the corners of the mouth
        albedo = mix(albedo * (1.0 + 0.05 * rim), red, lip * 0.92);
        oil = mix(oil, 0.80, lip);
    }
    colour = vec4(sqrt(clamp(albedo, 0.0, 1.0)), clamp(oil, 0.0, 1.0));
}
)";

constexpr const char* kStrokeVertex = R"(#version 450 core
layout(location = 0) in vec2 in_place;
layout(location = 1) in vec2 in_local;
layout(location = 2) in vec4 in_colour;
out vec2 local;
out vec4 tone;
void main() {
    local = in_local;
    tone = in_colour;
    gl_Position = vec4(2.0 * in_place - 1.0, 0.0, 1.0);
}
)";

constexpr const char* kStroke = R"(#version 450 core
in vec2 local;
in vec4 tone;
out vec4 colour;
void main() {
    // Soft at the root, full in the shaft, thinning to the tip
    float shaft = smoothstep(0.0, 0.25, local.x) * smoothstep(1.0, 0.55, local.x);
    float width = 1.0 - local.y * local.y;
    colour = vec4(tone.rgb, tone.a * shaft * width);
}
)";

}  // namespace

std::string paint_vertex_shader() { return kPaintVertex; }
std::string paint_fragment_shader() { return "#version 450 core\n" + noise_chunk() + kPaint; }
std::string stroke_vertex_shader() { return kStrokeVertex; }
std::string stroke_fragment_shader() { return kStroke; }

}  // namespace risorius::render
