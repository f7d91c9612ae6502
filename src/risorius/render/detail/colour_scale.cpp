// SPDX-License-Identifier: MIT
#include "risorius/render/detail/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/render/detail/activation_colour.h"
#include "risorius/render/detail/blend.h"
#include "risorius/render/detail/light.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/lettering.h"
#include "risorius/render/value_colour.h"

namespace risorius::render {
namespace {

// Fractions of the smaller side of the picture
constexpr double kMargin = 0.030, kBarLength = 0.22, kBarHeight = 0.016, kLetterHeight = 0.017;
constexpr double kMinLetter_px = 5;
constexpr double kRim = 0.35;

/// The colour that the shaders show when light and view are perpendicular to the surface.
Vec3 under_skin(const Vec3& muscle, const Appearance& appearance) {
    const Vec3 x =
        (1 - kSkinOverMuscles) * muscle + kSkinOverMuscles * linear_from_srgb(appearance.skin_tone);
    return x.unaryExpr([](double c) {  // same as shown() of shader_lighting.cpp
        const double over = std::max(c - kStraightTo, 0.0) / (1 - kStraightTo);
        return std::min(c, kStraightTo) + (1 - kStraightTo) * over / (1 + over);
    });
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace

void draw_colour_scale(const ColourScale& scale, const Background& background, Image& image) {
    const double side = std::min(image.width_px, image.height_px);
    const double letters = kLetterHeight * side;
    const bool written = letters >= kMinLetter_px;
    const double luminance =
        background.transparent
            ? 0.0
            : 0.2126 * background.rgb[0] + 0.7152 * background.rgb[1] + 0.0722 * background.rgb[2];
    const TextStyle style{.height_px = letters, .ink = luminance > 0.55 ? 0.08 : 0.96, .rim = kRim};

    const int left = static_cast<int>(std::lround(kMargin * side));
    const int top = left + static_cast<int>(std::lround(written ? 1.6 * letters : 0.0));
    const int length = std::max(8, static_cast<int>(std::lround(kBarLength * side)));
    const int height = std::max(2, static_cast<int>(std::lround(kBarHeight * side)));
    for (int x = 0; x < length && left + x < image.width_px; ++x) {
        const Vec3 colour = srgb_of_linear(scale.colour((x + 0.5) / length));
        for (int y = 0; y < height && top + y < image.height_px; ++y)
            blend(image.pixel(left + x, top + y), colour, 1);
    }
    if (!written) return;
    const double below = top + height + 1.5 * letters;
    write_text(scale.name, {left, left + letters}, style, image);
    write_text(scale.from, {left, below}, style, image);
    write_text(scale.to, {left + length - text_width(scale.to) * letters, below}, style, image);
}

ColourScale activation_scale(const Appearance& appearance) {
    return {.name = "activation", .from = "0", .to = "1", .colour = [appearance](double fraction) {
                return under_skin(activation_colour(fraction), appearance);
            }};
}

ColourScale values_scale(const SkinValues& values) {
    const double from = values.from, to = values.to;
    return {.name = values.unit.empty() ? values.name : values.name + ", " + values.unit,
            .from = number(from),
            .to = number(to),
            .colour = [from, to](double fraction) {
                return value_colour(from + fraction * (to - from), from, to);
            }};
}

}  // namespace risorius::render
