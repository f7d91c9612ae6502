// GLSL of the skin: soft scattering, two specular lobes, pores, painted albedo.
#include "render/detail/shaders.h"

namespace risorius::render {
namespace {

// Scattering under the skin as a wider, redder terminator (the wrap widths follow the mean free paths of red, green and
// blue light, Jensen 2001, over the radius of a cheek) and a red edge of the shadow; gloss from two lobes, a broad one of
// the skin and a narrow one of its oil, on a normal bent by pores.
constexpr const char* kSkin = R"(
in vec3 position;
in vec3 normal;
in vec2 paint;
in float sky_seen;
in float behind_seen;
out vec4 colour;
layout(binding = 1) uniform sampler2D paint_map;   // square root of albedo; a: oil
layout(binding = 2) uniform sampler2D pore_map;    // slope

const vec3 kWrap = vec3(0.34, 0.15, 0.09);

vec3 scattered(float nl) {
    vec3 t = clamp((nl + kWrap) / (1.0 + kWrap), 0.0, 1.0);
    return t * mix(vec3(1.0), t, 1.9 * kWrap);
}

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec4 painted = texture(paint_map, paint);
    vec3 albedo = painted.rgb * painted.rgb;
    float oil = painted.a;

    // The paint lies almost along world x and y on the face, which is frame enough for pores.
    // Lips have none, and towards the back the map is too stretched for them.
    float pores = 0.62 * smoothstep(0.80, 0.60, oil) * smoothstep(0.37, 0.27, length(paint - 0.5)) + 0.08;
    vec2 slope = (texture(pore_map, paint * 20.0).rg - 0.5) * pores;
    vec3 t = normalize(vec3(n.z, 0.0, -n.x) + vec3(1e-4, 0.0, 0.0));
    vec3 m = normalize(n - slope.x * t - slope.y * cross(n, t));

    float s = key_visibility(position, n);
    vec3 shade = s + s * (1.0 - s) * vec3(0.45, 0.05, 0.0);
    vec3 k = key_direction.xyz, f = fill_direction.xyz, r = rim_direction.xyz;
    vec3 ao = sky_seen + sky_seen * (1.0 - sky_seen) * vec3(0.40, 0.10, 0.0);

    float soft = dot(n, k), bent = dot(m, k);
    vec3 diffuse = key_radiance.rgb * shade * scattered(mix(soft, bent, 0.5));
    diffuse += fill_radiance.rgb * ao * scattered(mix(dot(n, f), dot(m, f), 0.5));
    diffuse += rim_radiance.rgb * behind_seen * scattered(dot(n, r));
    diffuse += ambient(m) * ao;

    float rough = 0.52 - 0.14 * oil;
    float narrow = rough * 0.58;
    float seen = sky_seen * sky_seen;
    vec3 gloss = key_radiance.rgb * s * two_glints(m, v, k, vec2(rough, narrow), vec2(0.75, 0.35 * oil), 0.028);
    gloss += fill_radiance.rgb * seen * glint(m, v, f, rough, 0.028);
    gloss += rim_radiance.rgb * behind_seen * behind_seen * glint(m, v, r, rough, 0.028);
    float edge = 1.0 - clamp(dot(n, v), 0.0, 1.0);
    gloss += ambient(reflect(-v, n)) * seen * (0.02 + 0.10 * edge * edge * edge * edge * sky_seen);
    colour = vec4(film(albedo * diffuse + gloss * 3.1416 * (0.20 + 1.10 * oil)), 1.0);
}
)";

}  // namespace

std::string skin_shader() { return lighting_chunk() + kSkin; }

}  // namespace risorius::render
