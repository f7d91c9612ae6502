// SPDX-License-Identifier: MIT
// GLSL of the lashes: single hairs cut out of the lash ribbons.
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

// Hairs are cut out of the ribbon in two rows of different spacing. Each hair has its own position, slant and length, and thins
// out to its tip.
constexpr const char* kLash = R"(
in vec3 position;
in vec3 normal;
in vec2 paint;            // m along the lid, 0..1 from root to tip
in float sky_seen;        // of a lash: 1 on the lower lid
out vec4 colour;
uniform vec3 albedo;      // linear

float random(float i, float row) { return fract(sin(i * 12.9898 + row * 78.233) * 43758.5453); }

// Share of half a hair's width at which the point lies, 1 at its edge.
float in_hair(float spacing, float half_width, float longest, float row) {
    float across = paint.x / spacing + 0.37 * row;
    // Hairs lean over into their neighbours' cells.
    float nearest = 4.0;
    for (float j = -1.0; j <= 1.0; j += 1.0) {
        float i = floor(across) + j;
        float lean = (random(i, row) - 0.5) * 1.5;
        float reach = longest * (0.62 + 0.38 * random(i, row + 5.0));
        float t = paint.y / reach;
        float middle = i + 0.5 + 0.5 * (random(i, row + 9.0) - 0.5) + lean * t * t;
        float width = half_width / spacing * (1.0 - 0.85 * t);
        if (t < 1.0) nearest = min(nearest, abs(across - middle) / max(width, 1e-4));
    }
    return nearest;
}

void main() {
    // The lower lid has few, thin and short ones.
    float edge = sky_seen > 0.5 ? in_hair(0.00110, 0.000070, 0.68, 1.0)
                               : min(in_hair(0.00072, 0.000105, 1.0, 1.0), in_hair(0.00109, 0.00009, 1.0, 2.0));
    if (edge > 1.0) discard;
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    float d = 0.5 + 0.5 * dot(n, key_direction.xyz);
    colour = vec4(shown(albedo * (key_card.rgb * d + ambient(n))), 1.0);
}
)";

}  // namespace

std::string lash_shader() { return lighting_chunk() + kLash; }

}  // namespace risorius::render
