// SPDX-License-Identifier: MIT
// GLSL of the skin: soft scattering, two specular lobes, pores, painted albedo.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

// Light scattered under the skin (see scattered()) with a red edge of the shadow. The gloss has two lobes, a broad one of the
// skin and a narrow one of its oil, on a normal bent by pores. Soft light comes from the vertices.
constexpr const char* kInputs = R"(
in vec3 position;
in vec3 normal;
in vec2 paint;
in float sky_seen;
in float curvature;
in vec3 soft;
in vec3 soft_gloss;
in float kept;
in float pores;
out vec4 colour;
)";
constexpr const char* kSkin = R"(
layout(binding = 1) uniform sampler2D paint_map;   // square root of albedo; a: oil
uniform vec3 scatter;      // m, of red, green and blue
uniform vec3 bleed;        // of the shadow's edge
uniform float roughness;
uniform float skin_gloss;
// Of the light in a hollow: what comes out again has been in the skin more than once.
const vec3 kHollow = vec3(0.40, 0.27, 0.23);
// Where it begins, some comes through thin walls from outside, red.
const vec3 kThroughWalls = vec3(0.055, 0.014, 0.010);

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec4 painted = texture(paint_map, paint);
    vec3 albedo = painted.rgb * painted.rgb;
    float oil = painted.a;

    vec3 m = bent_by_pores(n, oil);
    float open = fold(n, m);    // of the valleys of wrinkles to light
    m = normalize(m);
    albedo *= mix(kValley, vec3(1.0), open);

    vec3 k = key_direction.xyz;
    float rough = roughness - 0.14 * oil;
    vec2 lobes = sqrt(rough * rough * vec2(1.0, 0.3136) + kLampSize);
    // What lies in a nostril or in the bowl of an ear is in the dark, also where the shadow map is too coarse to know, and of
    // the light there little comes out again.
    float hollow = smoothstep(0.04, 0.50, sky_seen);
    float s = key_visibility(position, n) * hollow;
    vec3 shade = s + s * (1.0 - s) * bleed;
    vec3 key = key_card.rgb * shade * scattered(mix(dot(n, k), dot(m, k), 0.5), min(scatter * curvature, 0.5));
    vec3 gloss = key_card.rgb * (s * two_glints(m, v, k, lobes, vec2(0.90 - 0.40 * oil * oil, 0.10 + 0.40 * oil * oil), 0.028));
    // Pores and wrinkles turn to the soft light or away from it.
    float turned = 1.0 + dot(m - n, 0.6 * fill_direction.xyz + vec3(0.0, 0.35, 0.0));
    vec3 diffuse = (key * kept + soft * (open * turned)) * mix(kHollow, vec3(1.0), hollow);
    diffuse += kThroughWalls * (4.0 * hollow * (1.0 - hollow));
    gloss += soft_gloss * (open * open * turned * turned * hollow * hollow);
    vec3 skin = seen_through(albedo * diffuse, diffuse, albedo, oil, 1.0 - clamp(dot(n, v), 0.0, 1.0), sky_seen);
    colour = vec4(shown(skin + gloss * (kGloss * skin_gloss) * (0.52 + 0.80 * oil) * smoothstep(-0.03, 0.15, oil)), told());
}
)";

// On the face, the axes of the paint map lie almost along world x and y, which is accurate enough for pores. Lips have no pores.
constexpr const char* kPores = R"(
layout(binding = 2) uniform sampler2D pore_map;    // slope
vec3 bent_by_pores(vec3 n, float oil) {
    vec2 slope = (texture(pore_map, paint * 20.0).rg - 0.5) * (pores * (0.62 * smoothstep(0.80, 0.60, oil) + 0.08));
    vec3 t = normalize(vec3(n.z, 0.0, -n.x) + vec3(1e-4, 0.0, 0.0));
    return n - slope.x * t - slope.y * cross(n, t);
}
)";
constexpr const char* kNoPores = "vec3 bent_by_pores(vec3 n, float oil) { return n; }\n";
// Wrinkles have the height A d P(f) over the skin, with P = sqrt(sin^2(pi f) + r^2) and d of each line as in
// face/skin/detail/wrinkles.cpp: valleys are narrow and ridges round, and with A < 0 the ridges are narrow. The gradient of the
// phase on the drawn surface comes from its change between neighbouring samples (Mikkelsen 2010, Bump Mapping Unparametrized
// Surfaces). Wrinkles finer than two samples fade out.
constexpr const char* kFolds = R"(
in vec3 fold_phase;
in vec3 fold_depth;
const float kRounding = 0.2;
const vec3 kValley = vec3(0.92, 0.80, 0.76);

float fold(vec3 n, inout vec3 m) {
    vec3 px = dFdx(position), py = dFdy(position);
    vec3 fx = dFdx(fold_phase), fy = dFdy(fold_phase);
    vec3 ax = cross(py, n), ay = cross(n, px);
    float area = dot(px, ax);
    float open = 1.0;
    // Most of the skin has no fold at the moment, and leaves the loop before it begins.
    int sets = abs(area) < 1e-14 ? 0 : fold_depth.z != 0.0 ? 3 : fold_depth.y != 0.0 ? 2 : fold_depth.x != 0.0 ? 1 : 0;
    for (int i = 0; i < sets; ++i) {
        vec3 gradient = (fx[i] * ax + fy[i] * ay) / area;
        float shown = 1.0 - smoothstep(0.2, 0.5, length(vec2(fx[i], fy[i])));
        float s = sin(3.14159265 * fold_phase[i]), c = cos(3.14159265 * fold_phase[i]);
        float rounded = s * s + kRounding * kRounding;
        float depth = fold_depth[i] * shown * (1.0 + 0.4 * sin(2.4 * round(fold_phase[i])));
        m -= depth * 3.14159265 * s * c * inversesqrt(rounded) * gradient;
        float steep = max(depth, 0.0) * length(gradient);
        open *= 1.0 - min(0.75, 2.6 * steep) * (kRounding * kRounding) / rounded;
    }
    return open;
}
)";
constexpr const char* kNoFolds = R"(
const vec3 kValley = vec3(1.0);
float fold(vec3 n, vec3 m) { return 1.0; }
)";

// Value of alpha: 1 for an opaque picture, or the distance for a layer that is looked up; 0 says that there is no skin.
constexpr const char* kCovered = "float told() { return 1.0; }\n";
constexpr const char* kAway = R"(
float told() {
    return max(fract(distance(camera.xyz, position) * kTurnsPerMetre) * (256.0 / 255.0), 1.0 / 255.0);
}
)";

// Drafts: everything except paint and shadow is computed per vertex. The shadow taps of a 2 x 2 block of pixels form a square.
constexpr const char* kDraft = R"(
layout(binding = 0) uniform sampler2DShadow shadow_map;
layout(binding = 1) uniform sampler2D paint_map;   // square root of albedo; a: oil
uniform vec3 bleed;        // of the shadow's edge
uniform float skin_gloss;
in vec2 paint;
in vec3 soft;
in vec3 soft_gloss;
in vec3 key_light;
in float key_gloss;
in vec3 lit_at;
out vec4 colour;
void main() {
    vec4 painted = texture(paint_map, paint);
    vec3 albedo = painted.rgb * painted.rgb;
    float oil = painted.a;
    ivec2 q = ivec2(gl_FragCoord.xy) & 1;
    float reach = 0.0015 / (shadow_places.y * shadow_places.x);
    float s = textureLod(shadow_map, vec3(lit_at.xy + reach * (vec2(q) - 0.5), lit_at.z), 0.0);
    s += (0.5 - float(q.x)) * dFdxFine(s);
    s += (0.5 - float(q.y)) * dFdyFine(s);
    vec3 diffuse = key_light * (s + s * (1.0 - s) * bleed) + soft;
    vec3 gloss = key_card.rgb * (s * key_gloss) + soft_gloss;
    colour = vec4(shown(albedo * diffuse + gloss * skin_gloss * (0.52 + 0.80 * oil) * smoothstep(-0.03, 0.15, oil)), told());
}
)";

constexpr const char* kOpaque = R"(
const float kGloss = 1.0;
vec3 seen_through(vec3 skin, vec3 light, vec3 albedo, float oil, float edge, float open) { return skin; }
)";

// The nearest skin is a veil over the muscles, even over those that would lie in front of it; deep muscles fade into the tissue
// between. The veil is thicker at a slant, which keeps the shape of the face, and on lips, brows and in folds, which keeps its
// features.
constexpr const char* kTranslucent = R"(
const float kGloss = 0.6;
layout(binding = 3) uniform sampler2D muscle_colour;
layout(binding = 4) uniform sampler2D muscle_depth;
uniform vec2 distance_of_depth;
uniform float samples_per_slope;
uniform vec3 right;
uniform float tone;    // luminance of the cheek

const vec3 kTissue = vec3(0.40, 0.30, 0.25);

// Distance along the view; endless where there is no muscle.
float muscle_distance(ivec2 at) {
    return distance_of_depth.y / (2.0 * texelFetch(muscle_depth, at, 0).r - 1.0 + distance_of_depth.x);
}

// What a muscle nearer to the key light takes of it from what lies under it, d away. Each sample of a 2 x 2 block looks
// at another reach, so that the block together sees four.
float muscle_shadow(float d) {
    vec2 towards = vec2(dot(key_direction.xyz, right), key_direction.y) * (samples_per_slope / d);
    ivec2 q = ivec2(gl_FragCoord.xy) & 1;
    float reach = 0.0012 * float(1 + q.x + 2 * q.y);
    float higher = d - muscle_distance(ivec2(gl_FragCoord.xy + reach * towards));
    return smoothstep(0.0, 0.002, higher - 0.3 * reach) * (1.0 - smoothstep(0.010, 0.025, higher));
}

vec3 seen_through(vec3 skin, vec3 light, vec3 albedo, float oil, float edge, float open) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 muscle = texelFetch(muscle_colour, at, 0);
    float outside = 1.0 / gl_FragCoord.w, distance = muscle_distance(at);
    float seen = muscle.a * (1.0 - smoothstep(0.012, 0.060, distance - outside));
    float shadow = muscle_shadow(muscle.a > 0.5 ? distance : outside + 0.006);
    vec3 below = mix(kTissue * light, muscle.rgb, seen) * (1.0 - 0.5 * shadow);
    float dark = 1.0 - smoothstep(0.25, 0.75, dot(albedo, vec3(0.2126, 0.7152, 0.0722)) / tone);
    float veil = kVeil + (1.0 - kVeil) * edge * edge * edge;
    veil = max(veil, 0.72 * smoothstep(0.60, 0.80, oil));
    veil = max(veil, 0.60 * (1.0 - smoothstep(0.2, 0.7, open)));
    veil = max(veil, dark);
    return mix(below, skin, veil);
}
)";

std::string skin_with(const SkinRelief& relief, const std::string& told) {
    return std::string(kInputs) + (relief.folds ? kFolds : kNoFolds) +
           (relief.pores ? kPores : kNoPores) + told + kSkin;
}

}  // namespace

std::string told_chunk(bool layer) { return layer ? turns_chunk() + kAway : kCovered; }
std::string skin_shader(const SkinRelief& relief) {
    return lighting_chunk() + kOpaque + skin_with(relief, kCovered);
}
std::string skin_layer_shader(const SkinRelief& relief) {
    return lighting_chunk() + kOpaque + skin_with(relief, turns_chunk() + kAway);
}
std::string draft_skin_shader(bool layer) {
    return frame_chunk() + lights_chunk() + "in vec3 position;\n" + told_chunk(layer) + kDraft;
}
std::string veil_shader(const SkinRelief& relief) {
    return lighting_chunk() + "const float kVeil = " + std::to_string(kSkinOverMuscles) + ";\n" +
           kTranslucent + skin_with(relief, kCovered);
}

}  // namespace risorius::render
