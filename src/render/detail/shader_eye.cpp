// GLSL of the eye: sclera with veins, limbus, refracted iris and pupil, wet highlight, shade of the lids.
#include "render/detail/shaders.h"

namespace risorius::render {
namespace {

// Pattern from the rest position in the frame of the eye (z forward). Without a cornea of its own the surface is taken for
// it: the view ray is refracted there and meets the iris plane behind.
constexpr const char* kWindow = R"(
// The key as the eye mirrors it: photographers add a low lamp so that the catchlight stays clear of the upper lid.
vec3 catchlight() { return normalize(key_direction.xyz - vec3(0.0, 0.32, 0.0)); }

// A large soft lamp mirrored in the tear film: a disc whose edge falls off over a few degrees.
float window_light(vec3 back, vec3 l, float edge) {
    return 0.85 * smoothstep(edge, edge + 0.022, dot(back, l));
}

// What the tear film mirrors, where `open` of it sees the room.
vec3 wet_gloss(vec3 n, vec3 v, float open) {
    vec3 back = reflect(-v, n);
    vec3 gloss = key_card.rgb * sqrt(open) * window_light(back, catchlight(), 0.957);
    gloss += fill_card.rgb * open * 0.5 * window_light(back, fill_direction.xyz, 0.950);
    return gloss + open * mirrored_share(clamp(dot(n, v), 0.0, 1.0), 0.08, 0.025) * mirrored(back, 0.0);
}
)";

constexpr const char* kEye = R"(
in vec3 position;
in vec3 normal;
in vec3 rest;
in vec3 soft;
in float kept;
out vec4 colour;
uniform mat3 eye_from_rest;
uniform mat3 eye_from_world;
uniform vec3 centre;        // rest, m
uniform float iris_radius;
uniform float pupil_radius;
uniform float iris_depth;   // height of the iris plane over the centre, m
uniform bool separate_cornea;
uniform vec3 iris_tone;     // linear
uniform vec3 lid_inner, lid_outer, lid_upper, lid_lower;  // world, m
uniform float lids;         // 1 when they are known

// Height of the lid margins over the line between the canthi, and from it the shadow the lids throw on the eye.
float lid_shade(vec3 p) {
    vec3 across = lid_outer - lid_inner;
    float width = max(length(across), 1e-4);
    across /= width;
    vec3 up = normalize(vec3(0.0, 1.0, 0.0) - across * across.y);
    vec3 d = p - lid_inner;
    float s = 2.0 * clamp(dot(d, across) / width, 0.0, 1.0) - 1.0;
    float bow = 1.0 - s * s * sqrt(abs(s));
    float y = dot(d, up);
    float below_upper = dot(lid_upper - lid_inner, up) * bow - y;
    float above_lower = y - dot(lid_lower - lid_inner, up) * bow;
    float upper = smoothstep(-0.0006, 0.0042, below_upper);
    float lower = smoothstep(-0.0010, 0.0016, above_lower);
    float corner = smoothstep(1.02, 0.60, abs(s));
    return mix(1.0, (0.16 + 0.84 * upper) * (0.55 + 0.45 * lower) * (0.55 + 0.45 * corner), lids);
}

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 q = eye_from_rest * (rest - centre);
    vec3 hit = q;
    vec3 wet = n;   // normal of the tear film
    if (!separate_cornea) {
        // Scans have little or no corneal bulge; a cornea curves with 1.31 times the radius of its iris.
        vec2 c = q.xy / (1.31 * iris_radius);
        vec3 bulge = vec3(c, sqrt(max(1.0 - dot(c, c), 0.05)));
        float on_cornea = q.z > 0.0 ? smoothstep(1.15, 0.90, length(q.xy) / iris_radius) : 0.0;
        vec3 local = normalize(mix(eye_from_world * n, bulge, on_cornea));
        wet = local * eye_from_world;
        vec3 d = refract(-(eye_from_world * v), local, 1.0 / 1.336);
        float depth = max(q.z - iris_depth, 0.0) / max(-d.z, 0.2);
        hit = q + d * depth;
    }
    float surface_r = length(q.xy) / iris_radius;
    float r = length(hit.xy) / iris_radius;
    bool ahead = q.z > 0.0;

    // Sclera: warm white, redder and veined towards the corners
    vec3 white = vec3(0.70, 0.655, 0.61);
    vec2 w = q.xy * 900.0;
    float ridge = 1.0 - abs(2.0 * noise(vec3(w * vec2(0.35, 1.1) + 40.0 + 1.5 * noise(vec3(w * 0.6 + 60.0, 3.0)), 7.0)) - 1.0);
    float far = smoothstep(1.15, 2.1, surface_r);
    white *= mix(vec3(1.0), vec3(0.93, 0.62, 0.57), far * smoothstep(0.90, 1.0, ridge) * 0.75);
    white *= mix(vec3(1.0), vec3(0.95, 0.80, 0.76), far * 0.6);

    // Iris: fibres, a warm collarette around the pupil, a dark limbal ring
    vec2 round_ = hit.xy / max(length(hit.xy), 1e-6);
    float fibre = noise(vec3(round_ * 17.0 + 50.0, r * 3.0 + 5.0)) * 0.6 + noise(vec3(round_ * 38.0 + 90.0, r * 5.0 + 9.0)) * 0.4;
    float p = pupil_radius / iris_radius;
    float ring = (r - p) / (1.0 - p);
    vec3 base = mix(iris_tone, vec3(dot(iris_tone, vec3(0.3, 0.5, 0.2))), 0.35);
    vec3 iris = base * (0.22 + 0.75 * fibre);
    vec3 warm = vec3(0.24, 0.13, 0.045) * (0.5 + 0.9 * fibre);
    iris = mix(iris, warm, 0.55 * smoothstep(0.42, 0.08, ring + 0.25 * (fibre - 0.5)));
    iris *= mix(1.0, 0.28, smoothstep(0.72, 1.0, r));
    iris *= smoothstep(-0.05, 0.16, ring) * 0.75 + 0.25;
    // Light through the cornea gathers on the side away from it.
    vec3 l = eye_from_world * key_direction.xyz;
    float gathered = 1.0 - 0.55 * dot(round_, l.xy) * clamp(r, 0.0, 1.0);
    vec3 inner = mix(vec3(0.004), iris * gathered, smoothstep(p - 0.05, p + 0.04, r));
    float is_iris = ahead ? 1.0 - smoothstep(0.92, 1.06, r) : 0.0;
    vec3 albedo = mix(white, inner, is_iris);
    albedo *= mix(1.0, 0.80, smoothstep(1.25, 1.02, r) * (1.0 - is_iris));

    float open = lid_shade(position);
    float s = key_visibility(position, n) * open;
    vec3 k = key_direction.xyz;
    // The eyeball scatters so strongly that it hardly shades; the iris lies flat behind the cornea.
    vec3 flat_n = normalize(mix(n, v, 0.5 * is_iris));
    vec3 light = key_card.rgb * s * scattered(dot(flat_n, k), vec3(0.40, 0.33, 0.28)) + soft * open;
    vec3 c = albedo * light;

    // Wet surface: a window of the key, one of the fill, and the surroundings
    if (!separate_cornea) c += wet_gloss(wet, v, open);
    colour = vec4(shown(c), 1.0);
}
)";

constexpr const char* kCornea = R"(
in vec3 position;
in vec3 normal;
out vec4 colour;
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 gloss = wet_gloss(n, v, smoothstep(0.0, 0.4, key_visibility(position, n)));
    // Premultiplied: clear glass adds its highlight and hides next to nothing.
    colour = vec4(shown(gloss), clamp(dot(gloss, vec3(0.3)), 0.0, 0.9));
}
)";

}  // namespace

std::string eye_shader() { return lighting_chunk() + noise_chunk() + kWindow + kEye; }
std::string cornea_shader() { return lighting_chunk() + kWindow + kCornea; }

}  // namespace risorius::render
