// GLSL shared by all materials: lights, shadow, tone and noise.
#include "render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kFrame = R"(#version 450 core
layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_world;
    mat4 shadow_from_world;
    vec4 camera;
    vec4 key_direction, key_radiance;
    vec4 fill_direction, fill_radiance;
    vec4 rim_direction, rim_radiance;
    vec4 sky, ground;
    vec4 mouth_centre, mouth_axis;
};
)";

constexpr const char* kLights = R"(
layout(binding = 0) uniform sampler2DShadow shadow_map;

// Soft edge of the key light. Neighbouring samples of a 2 x 2 block turn the taps by a quarter of their spacing,
// so that the block together sees four times as many.
float key_visibility(vec3 p, vec3 n) {
    float texel = mouth_axis.w;
    vec3 c = (shadow_from_world * vec4(p + n * (2.5 * texel), 1.0)).xyz;
    ivec2 q = ivec2(gl_FragCoord.xy) & 1;
    // Turned by 0, 18, 36 and 54 degrees, over a disc of 3.5 mm.
    vec2 turned = q.x == q.y ? (q.x == 0 ? vec2(1.0, 0.0) : vec2(0.9511, 0.3090))
                             : (q.x == 0 ? vec2(0.8090, 0.5878) : vec2(0.5878, 0.8090));
    vec2 e = turned * (0.0035 / (texel * float(textureSize(shadow_map, 0).x)));
    vec2 f = vec2(-e.y, e.x);
    // A pentagon around a triangle: the disc filled evenly.
    float s = texture(shadow_map, vec3(c.xy + e, c.z));
    s += texture(shadow_map, vec3(c.xy + 0.309 * e + 0.951 * f, c.z));
    s += texture(shadow_map, vec3(c.xy - 0.809 * e + 0.588 * f, c.z));
    s += texture(shadow_map, vec3(c.xy - 0.809 * e - 0.588 * f, c.z));
    s += texture(shadow_map, vec3(c.xy + 0.309 * e - 0.951 * f, c.z));
    s += texture(shadow_map, vec3(c.xy - 0.48 * e, c.z));
    s += texture(shadow_map, vec3(c.xy + 0.24 * e + 0.416 * f, c.z));
    s += texture(shadow_map, vec3(c.xy + 0.24 * e - 0.416 * f, c.z));
    return s * 0.125;
}

// GGX with the visibility term of Kelemen and Szirmay-Kalos 2001; includes the cosine at the surface.
float glint(vec3 n, vec3 v, vec3 l, float roughness, float f0) {
    vec3 h = normalize(v + l);
    float nl = clamp(dot(n, l), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), lh = clamp(dot(l, h), 0.0, 1.0);
    float a2 = roughness * roughness;
    a2 *= a2;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float m = 1.0 - lh, m2 = m * m;
    float fresnel = f0 + (1.0 - f0) * m2 * m2 * m;
    return nl * fresnel * a2 / (12.566 * d * d * max(lh * lh, 0.05));
}

// Two lobes of one light, each with its roughness and share.
float two_glints(vec3 n, vec3 v, vec3 l, vec2 roughness, vec2 share, float f0) {
    vec3 h = normalize(v + l);
    float nl = clamp(dot(n, l), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), lh = clamp(dot(l, h), 0.0, 1.0);
    vec2 a2 = roughness * roughness;
    a2 *= a2;
    vec2 d = nh * nh * (a2 - 1.0) + 1.0;
    float m = 1.0 - lh, m2 = m * m;
    float fresnel = f0 + (1.0 - f0) * m2 * m2 * m;
    return nl * fresnel * dot(share, a2 / (d * d)) / (12.566 * max(lh * lh, 0.05));
}

// Light from all around: what the sky half and the ground half send.
vec3 ambient(vec3 n) { return mix(ground.rgb, sky.rgb, 0.5 + 0.5 * n.y); }

// Fit of the ACES filmic curve by Narkowicz 2015.
vec3 film(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }
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

// What the wrinkles of the skin need, see shader_skin.cpp
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
constexpr const char* kNoFoldsVertex = "void pass_folds() {}";

constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_rest;
layout(location = 3) in vec2 in_paint;
layout(location = 4) in vec2 in_occlusion;
out vec3 position;
out vec3 normal;
out vec3 rest;
out vec2 paint;
out float sky_seen;
out float behind_seen;    // of light from behind the head, which never comes in through the lips
uniform bool inside_mouth;

// Share of what comes through the open lips that reaches a point behind them: the gap seen as a disc at the distance of
// the nearest point of its long axis.
float seen_through_lips(vec3 p) {
    vec3 d = p - mouth_centre.xyz, a = mouth_axis.xyz;
    d -= a * clamp(dot(d, a) / max(dot(a, a), 1e-9), -0.75, 0.75);
    return mouth_centre.w / (mouth_centre.w + 3.1416 * dot(d, d) + 1e-9);
}

void main() {
    position = in_position;
    normal = in_normal;
    rest = in_rest;
    paint = in_paint;
    pass_folds();
    float inside = inside_mouth ? 1.0 : in_occlusion.y;
    sky_seen = mix(in_occlusion.x, seen_through_lips(in_position), inside);
    behind_seen = (1.0 - inside) * in_occlusion.x;
    gl_Position = clip_from_world * vec4(in_position, 1.0);
}
)";

constexpr const char* kDepthVertex = R"(#version 450 core
layout(location = 0) in vec3 in_position;
uniform mat4 clip_from_world;
void main() { gl_Position = clip_from_world * vec4(in_position, 1.0); }
)";

}  // namespace

std::string frame_chunk() { return kFrame; }
std::string lighting_chunk() { return std::string(kFrame) + kLights; }
std::string noise_chunk() { return kNoise; }
std::string surface_vertex_shader(bool folds) {
    return std::string(kFrame) + (folds ? kFoldsVertex : kNoFoldsVertex) + kSurfaceVertex;
}
std::string depth_vertex_shader() { return kDepthVertex; }

}  // namespace risorius::render
