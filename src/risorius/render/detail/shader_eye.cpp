// SPDX-License-Identifier: MIT
// GLSL of the eye: sclera with veins, limbus, refracted iris and pupil, wet highlight, shadow of the lids.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

// The pattern is computed from the rest position in the frame of the eye (z forward), together with the shape of the cornea.
constexpr const char* kEyeColour = R"(
uniform mat3 eye_from_rest;
uniform vec3 centre;        // rest, m
uniform float iris_radius;
uniform float pupil_radius;
uniform float iris_depth;   // height of the iris plane over the centre, m
uniform vec3 iris_tone;     // linear
uniform float skin_green;   // linear
uniform float age;          // 0..1

// Normal in the frame of the eye at q from its centre: a cornea curves with 1.31 times the radius of its iris and goes over into
// the ball. Meshes have no, little or a coarse bulge.
vec3 cornea_normal(vec3 q, vec3 ball, float iris) {
    vec2 c = q.xy / (1.31 * iris);
    vec3 bulge = vec3(c, sqrt(max(1.0 - dot(c, c), 0.05)));
    return normalize(mix(ball, bulge, q.z > 0.0 ? smoothstep(1.15, 0.90, length(q.xy) / iris) : 0.0));
}

// Where a ray that meets the surface at q against `v` is refracted to on the plane of the iris, in the frame of the eye.
vec3 through_cornea(vec3 q, vec3 v, vec3 cornea) {
    vec3 d = refract(-v, cornea, 1.0 / 1.336);
    float depth = max(q.z - iris_depth, 0.0) / max(-d.z, 0.2);
    return q + d * depth;
}

// Thin lines where a noise passes a height; they wander from the corners towards the iris, p in mm.
float vein(vec3 p, float width) {
    float a = noise(p * vec3(0.22, 0.75, 0.75) + 40.0 + 1.3 * noise(p * 0.8 + 60.0));
    return smoothstep(width, 0.0, abs(a - 0.5));
}
float veins(vec3 p, float far) {
    float thick = vein(p, 0.055) * smoothstep(0.25, 0.6, noise(p * 0.5 + 20.0));
    float fine = vein(1.9 * p + 11.0, 0.075) * smoothstep(0.25, 0.6, noise(p * 0.7 + 80.0));
    return 0.12 * fine + far * (0.65 * thick + 0.40 * fine);
}

// Of the surface at q, where one sees `hit` through it; `caruncle`: how much of it is that, `gathered`: light on the iris.
vec3 eye_colour(vec3 q, vec3 hit, float caruncle, float gathered, out float is_iris) {
    float surface_r = length(q.xy) / iris_radius;
    float r = length(hit.xy) / iris_radius;
    bool ahead = q.z > 0.0;

    // Sclera: warm white, veined and redder towards the corners, bluish where it thins out over the iris' edge
    float far = smoothstep(1.10, 2.0, surface_r);
    vec3 white = mix(vec3(0.58, 0.54, 0.495), vec3(0.51, 0.425, 0.37), far);
    // Darker people have a darker conjunctiva; with the years it yellows.
    white *= mix(vec3(0.84, 0.80, 0.74), vec3(1.0), smoothstep(0.02, 0.35, skin_green));
    white *= mix(vec3(1.0), vec3(1.0, 0.97, 0.90), age);
    white *= mix(vec3(1.0), vec3(0.92, 0.46, 0.40), veins(q * 1000.0, far));
    white = mix(white, vec3(0.62, 0.30, 0.26), 0.9 * caruncle);

    // Iris: fibres, a warm collarette around the pupil, a dark limbal ring
    vec2 round_ = hit.xy / max(length(hit.xy), 1e-6);
    float fibre = noise(vec3(round_ * 17.0 + 50.0, r * 3.0 + 5.0)) * 0.6 + noise(vec3(round_ * 38.0 + 90.0, r * 5.0 + 9.0)) * 0.4;
    float p = pupil_radius / iris_radius;
    float ring = (r - p) / (1.0 - p);
    vec3 base = mix(iris_tone, vec3(dot(iris_tone, vec3(0.3, 0.5, 0.2))), 0.35);
    vec3 iris = base * (0.22 + 0.75 * fibre);
    vec3 warm = vec3(0.24, 0.13, 0.045) * (0.5 + 0.9 * fibre);
    iris = mix(iris, warm, 0.55 * smoothstep(0.42, 0.08, ring + 0.25 * (fibre - 0.5)));
    iris *= mix(1.0, 0.30, smoothstep(0.74, 0.98, r));
    iris *= smoothstep(-0.05, 0.16, ring) * 0.75 + 0.25;
    vec3 inner = mix(vec3(0.004), iris * gathered, smoothstep(p - 0.05, p + 0.04, r));
    // The sclera reaches over the iris' rim and shows it through.
    is_iris = ahead ? 1.0 - smoothstep(0.90, 1.10, r) : 0.0;
    vec3 albedo = mix(white, inner, is_iris);
    // In old age a pale ring of fat lies in the rim of the cornea.
    float arcus = smoothstep(0.60, 0.85, age) * smoothstep(0.88, 0.95, surface_r) * smoothstep(1.10, 1.03, surface_r);
    albedo = mix(albedo, vec3(0.55, 0.57, 0.58), ahead ? 0.6 * arcus : 0.0);
    return albedo * mix(vec3(1.0), vec3(0.70, 0.74, 0.78), ahead ? smoothstep(1.24, 1.02, r) * (1.0 - is_iris) : 0.0);
}
)";

constexpr const char* kWindow = R"(
// The key as the eye mirrors it: photographers add a low lamp so that the catchlight stays clear of the upper lid.
vec3 catchlight() { return normalize(key_direction.xyz - vec3(0.0, 0.22, 0.0)); }

// A soft box mirrored in the tear film: higher than wide, with round corners, brightest above its middle, dimmer towards its
// edges, which fall off over some degrees.
float window_light(vec3 back, vec3 l) {
    vec3 right = normalize(vec3(l.z, 0.0, -l.x) + vec3(1e-4, 0.0, 0.0));
    float ahead = max(dot(back, l), 0.05);
    vec2 at = vec2(dot(back, right), dot(back, cross(l, right))) / (ahead * vec2(0.27, 0.33));
    vec2 corner = max(abs(at) - 0.35, 0.0);
    float edge = length(corner) / 0.65;
    vec2 off = at - vec2(0.0, 0.25);
    return smoothstep(1.20, 0.60, edge) * (0.95 - 0.52 * min(dot(off, off), 1.3));
}

// The furrow around the cornea is too narrow to show a lamp of its own.
float off_furrow(float r) { return 1.0 - 0.9 * smoothstep(0.86, 0.94, r) * smoothstep(1.22, 1.12, r); }

// What the tear film mirrors, where `open` of it sees the room.
vec3 wet_gloss(vec3 n, vec3 v, float open) {
    vec3 back = reflect(-v, n);
    vec3 gloss = key_card.rgb * sqrt(open) * window_light(back, catchlight());
    // The fill is a wall that throws light back: it has no edge.
    float wall = max(dot(back, fill_direction.xyz), 0.0);
    wall *= wall;
    gloss += fill_card.rgb * (open * 0.10 * wall * wall);
    return gloss + open * mirrored_share(clamp(dot(n, v), 0.0, 1.0), 0.08, 0.025) * mirrored(back, 0.0);
}
)";

// An eye without a separate cornea: the surface acts as the cornea, which refracts the view ray onto the iris plane behind it.
constexpr const char* kEye = R"(
in vec3 position;
in vec3 normal;
in vec3 rest;
in vec3 soft;
in float kept;
out vec4 colour;
uniform mat3 eye_from_world;
uniform bool separate_cornea;
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
    float upper = smoothstep(0.0014, 0.0068, below_upper);
    float lower = smoothstep(-0.0010, 0.0016, above_lower);
    float corner = smoothstep(1.02, 0.60, abs(s));
    return mix(1.0, (0.26 + 0.74 * upper) * (0.55 + 0.45 * lower) * (0.45 + 0.55 * corner), lids);
}

void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 v = normalize(camera.xyz - position);
    vec3 q = eye_from_rest * (rest - centre);
    vec3 hit = q;
    vec3 wet = n;   // normal of the tear film
    if (!separate_cornea) {
        vec3 local = cornea_normal(q, eye_from_world * n, iris_radius);
        wet = local * eye_from_world;
        hit = through_cornea(q, eye_from_world * v, local);
    }
    float surface_r = length(q.xy) / iris_radius;
    float r = length(hit.xy) / iris_radius;
    vec3 from_inner = position - lid_inner;
    float caruncle = lids * exp(-dot(from_inner, from_inner) * 2.4e4);

    vec2 round_ = hit.xy / max(length(hit.xy), 1e-6);
    // Light through the cornea gathers in a crescent on the side away from the lamp, the more the farther the lamp is aside.
    vec2 l = (eye_from_world * key_direction.xyz).xy;
    float away = -dot(round_, l) * r;
    float gathered = 1.0 - 0.40 * length(l) + 1.5 * smoothstep(-0.15, 0.55, away) * smoothstep(1.02, 0.80, r) * length(l);
    float is_iris;
    vec3 albedo = eye_colour(q, hit, caruncle, gathered, is_iris);
    albedo = own_colour(rest, albedo);
    if (kOwn) albedo *= mix(1.0, gathered, is_iris);

    float open = lid_shade(position);
    float s = key_visibility(position, n) * open;
    vec3 k = key_direction.xyz;
    // The eyeball scatters so strongly that it hardly shades; the iris lies flat behind the cornea.
    vec3 flat_n = normalize(mix(n, v, 0.5 * is_iris));
    vec3 light = key_card.rgb * s * scattered(dot(flat_n, k), vec3(0.40, 0.33, 0.28)) + soft * open;
    vec3 c = albedo * light;

    // Wet surface: the soft box of the key, the glow of the fill, and the surroundings
    if (!separate_cornea) c += wet_gloss(wet, v, open * off_furrow(surface_r));
    colour = vec4(shown(c), 1.0);
}
)";

constexpr const char* kCornea = R"(
in vec3 position;
in vec3 rest;
out vec4 colour;
uniform mat3 eye_from_world;
void main() {
    vec3 q = eye_from_rest * (rest - centre);
    vec3 n = cornea_normal(q, normalize(q), iris_radius) * eye_from_world;
    vec3 v = normalize(camera.xyz - position);
    vec3 gloss = wet_gloss(n, v, smoothstep(0.0, 0.4, key_visibility(position, n)) *
                     (q.z > 0.0 ? off_furrow(length(q.xy) / iris_radius) : 1.0));
    // Premultiplied: clear glass adds its highlight and hides next to nothing.
    colour = vec4(shown(gloss), clamp(dot(gloss, vec3(0.3)), 0.0, 0.9));
}
)";

// Texture of an eye as seen from straight ahead in even light.
constexpr const char* kEyeTexture = R"(
void main() {
    vec3 q = eye_from_rest * (rest - centre);
    vec3 cornea = cornea_normal(q, normalize(eye_from_rest * normal), iris_radius);
    float is_iris;
    colour = vec4(eye_colour(q, through_cornea(q, vec3(0.0, 0.0, 1.0), cornea), 0.0, 1.0, is_iris), 1.0);
}
)";

}  // namespace

std::string eye_shader(bool own) {
    return lighting_chunk() + noise_chunk() + own_colour_chunk(own) + kEyeColour + kWindow + kEye;
}
std::string cornea_shader() {
    return lighting_chunk() + noise_chunk() + kEyeColour + kWindow + kCornea;
}
std::string eye_texture_shader() {
    return texture_inputs_chunk() + noise_chunk() + kEyeColour + kEyeTexture;
}

}  // namespace risorius::render
