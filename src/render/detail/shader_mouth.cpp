// GLSL of teeth, gums, tongue and mouth wall, lit through the lips.
#include "render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kTeeth = R"(
in vec3 position;
in vec3 normal;
in float sky_seen;
out vec4 colour;
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 k = key_direction.xyz, f = fill_direction.xyz;
    float s = key_visibility(position, n) * min(1.0, 1.6 * sky_seen);
    vec3 wrap = vec3(0.35, 0.32, 0.28);
    vec3 kd = clamp((dot(n, k) + wrap) / (1.0 + wrap), 0.0, 1.0);
    vec3 fd = clamp((dot(n, f) + wrap) / (1.0 + wrap), 0.0, 1.0);
    vec3 enamel = vec3(0.52, 0.465, 0.375);
    // Dim light in the mouth has been to its red walls.
    vec3 tint = mix(vec3(0.75, 0.42, 0.36), vec3(1.0), smoothstep(0.05, 0.6, sky_seen));
    vec3 light = key_radiance.rgb * kd * s + (fill_radiance.rgb * fd + ambient(n)) * sky_seen * tint;
    vec3 gloss = key_radiance.rgb * s * min(glint(n, v, k, 0.26, 0.04), 1.0);
    gloss += fill_radiance.rgb * sky_seen * glint(n, v, f, 0.3, 0.04);
    colour = vec4(film(enamel * light + gloss), 1.0);
}
)";

constexpr const char* kMucosa = R"(
in vec3 position;
in vec3 normal;
in vec3 rest;
in float sky_seen;
out vec4 colour;
uniform vec3 albedo;      // linear
uniform float bumps;      // amplitude of the papillae
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 k = key_direction.xyz, f = fill_direction.xyz;
    vec3 p = rest * 1400.0 + 500.0;
    float a = noise(p);
    vec3 m = normalize(n + bumps * (vec3(noise(p + 17.0), a, noise(p + 31.0)) - 0.5));
    float s = key_visibility(position, n) * min(1.0, 1.6 * sky_seen);
    vec3 wrap = vec3(0.4, 0.2, 0.15);
    vec3 kd = clamp((dot(m, k) + wrap) / (1.0 + wrap), 0.0, 1.0);
    vec3 fd = clamp((dot(m, f) + wrap) / (1.0 + wrap), 0.0, 1.0);
    vec3 light = key_radiance.rgb * kd * s + (fill_radiance.rgb * fd + ambient(n)) * sky_seen;
    vec3 gloss = key_radiance.rgb * s * min(glint(m, v, k, 0.30, 0.03), 1.0);
    gloss += fill_radiance.rgb * sky_seen * glint(m, v, f, 0.34, 0.03);
    colour = vec4(film(albedo * (0.8 + 0.4 * a) * light + 0.8 * gloss), 1.0);
}
)";

}  // namespace

std::string teeth_shader() { return lighting_chunk() + kTeeth; }
std::string mucosa_shader() { return lighting_chunk() + noise_chunk() + kMucosa; }

}  // namespace risorius::render
