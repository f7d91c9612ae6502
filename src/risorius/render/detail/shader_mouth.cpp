// SPDX-License-Identifier: MIT
// GLSL of teeth, gums, tongue and mouth wall, lit through the lips, and of cards for light measurements.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr const char* kMouthInputs = R"(
in vec3 position;
in vec3 normal;
in vec3 rest;
in float sky_seen;
in vec3 soft;
in vec3 soft_gloss;
in float kept;
out vec4 colour;
)";

constexpr const char* kEnamel = R"(
vec3 enamel_at(vec3 rest) { return vec3(0.80, 0.70, 0.56) * (0.96 + 0.08 * noise(rest * 900.0 + 300.0)); }
)";

constexpr const char* kTeeth = R"(
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 k = key_direction.xyz;
    float s = fine_visibility(position, n) * min(1.0, 1.6 * sky_seen);
    vec3 enamel = own_colour(rest, enamel_at(rest));
    // Dim light in the mouth has been to its red walls.
    vec3 tint = mix(vec3(1.45, 1.28, 1.22), vec3(1.08), smoothstep(0.05, 0.5, sky_seen));
    vec3 light = key_card.rgb * s * kept * scattered(dot(n, k), vec3(0.45, 0.40, 0.33)) + soft * tint;
    vec3 gloss = key_card.rgb * s * min(glint(n, v, k, 0.22, 0.045), 1.0);
    gloss += sky_seen * sky_seen * mirrored_share(clamp(dot(n, v), 0.0, 1.0), 0.22, 0.045) * mirrored(reflect(-v, n), 1.0);
    colour = vec4(shown(enamel * light + gloss), 1.0);
}
)";

// The back of the tongue: a furrow in the middle, papillae of half a millimetre with redder ones among them, and a pale coating.
constexpr const char* kTongueBack = R"(
const float kWet = 1.8;
vec3 back_of(vec3 n, vec3 tint, inout vec3 m) {
    float above = smoothstep(0.1, 0.7, n.y);
    float x = rest.x / 0.0030;
    m.x -= 0.85 * above * x * exp(-x * x);
    vec3 p = rest * 1900.0 + 700.0;
    float papillae = noise(p);
    m += above * 0.9 * (vec3(noise(p + 19.0), papillae, noise(p + 37.0)) - 0.5);
    float red = smoothstep(0.80, 0.90, noise(rest * 620.0 + 90.0));
    vec3 coat = mix(tint, vec3(0.50, 0.27, 0.24), above * 0.55 * papillae * (1.0 - red));
    return coat * (1.0 - 0.45 * above * exp(-2.0 * x * x)) * (0.72 + 0.5 * papillae);
}
)";
constexpr const char* kSmoothMucosa = R"(
const float kWet = 1.0;
vec3 back_of(vec3 n, vec3 tint, vec3 m) { return tint; }
)";

constexpr const char* kMucosaColour = R"(
uniform vec3 albedo;      // linear
vec3 mucosa_at(float speck) { return albedo * (0.8 + 0.4 * speck); }
)";

constexpr const char* kMucosa = R"(
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 k = key_direction.xyz;
    vec3 p = rest * 1400.0 + 500.0;
    float a = noise(p);
    vec3 m = n + 0.12 * (vec3(noise(p + 17.0), a, noise(p + 31.0)) - 0.5);
    vec3 tint = back_of(n, own_colour(rest, mucosa_at(a)), m);
    m = normalize(m);
    float s = fine_visibility(position, n) * min(1.0, 1.6 * sky_seen);
    vec3 light = key_card.rgb * s * kept * scattered(dot(m, k), vec3(0.4, 0.2, 0.15)) + soft;
    vec3 gloss = key_card.rgb * s * min(glint(m, v, k, 0.26, 0.03), 1.2);
    gloss += sky_seen * sky_seen * mirrored_share(clamp(dot(m, v), 0.0, 1.0), 0.26, 0.03) * mirrored(reflect(-v, m), 1.0);
    colour = vec4(shown(tint * light + kWet * gloss), 1.0);
}
)";

// Enamel is a clear coat over dentine. Dentine shows yellower at the neck, where the crown is thickest, and ends before the edge,
// which is grey because the dark mouth shows through it.
constexpr const char* kTeethTexture = R"(
const vec3 kNeck = vec3(0.93, 0.83, 0.69);
const vec3 kEdge = vec3(0.78, 0.83, 0.91);
void main() {
    float wander = 0.10 * (noise(rest * 700.0 + 40.0) - 0.5);
    vec3 enamel = enamel_at(rest) * mix(kNeck, vec3(1.0), smoothstep(0.15, 0.65, crown_height + wander));
    colour = vec4(enamel * mix(vec3(1.0), kEdge, smoothstep(0.85, 1.0, crown_height + 0.3 * wander)), 1.0);
}
)";

constexpr const char* kMucosaTexture = R"(
void main() {
    vec3 m = vec3(0.0);
    vec3 n = normalize(normal);
    colour = vec4(back_of(n, mucosa_at(noise(rest * 1400.0 + 500.0)), m), 1.0);
}
)";

constexpr const char* kMatte = R"(
uniform vec3 albedo;      // linear
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    float lit = max(dot(n, key_direction.xyz), 0.0) * fine_visibility(position, n);
    colour = vec4(shown(albedo * (key_card.rgb * lit + soft)), 1.0);
}
)";

}  // namespace

std::string teeth_shader(bool own) {
    return lighting_chunk() + noise_chunk() + own_colour_chunk(own) + kMouthInputs + kEnamel +
           kTeeth;
}
std::string mucosa_shader(bool tongue, bool own) {
    return lighting_chunk() + noise_chunk() + own_colour_chunk(own) + kMouthInputs +
           (tongue ? kTongueBack : kSmoothMucosa) + kMucosaColour + kMucosa;
}
std::string teeth_texture_shader() {
    return texture_inputs_chunk() + noise_chunk() + kEnamel + kTeethTexture;
}
std::string mucosa_texture_shader(bool tongue) {
    return texture_inputs_chunk() + noise_chunk() + (tongue ? kTongueBack : kSmoothMucosa) +
           kMucosaColour + kMucosaTexture;
}
std::string matte_shader() { return lighting_chunk() + kMouthInputs + kMatte; }

}  // namespace risorius::render
