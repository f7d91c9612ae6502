#include "render/detail/activation_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "render/activation_colour.h"
#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

namespace risorius::render {
namespace {

// Shares of the smaller side of the picture
constexpr double kMargin = 0.030, kBarLength = 0.22, kBarHeight = 0.016, kLetterHeight = 0.017;
constexpr double kLeastLetter_px = 5;
constexpr double kStroke = 0.13;  ///< of the height of a capital
constexpr double kGap = 0.20;     ///< between letters, of that height

using Line = std::vector<Vec2>;  ///< x to the right, y down, baseline 0, height of a capital 1

struct Letter {
    double width;
    std::vector<Line> lines;
};

/// Part of an ellipse, angles in degrees from the right, clockwise as seen.
Line arc(double x, double y, double rx, double ry, double from_deg, double to_deg) {
    constexpr int kSteps = 14;
    Line line;
    for (int i = 0; i <= kSteps; ++i) {
        const double a = (from_deg + (to_deg - from_deg) * i / kSteps) * std::numbers::pi / 180;
        line.emplace_back(x + rx * std::cos(a), y + ry * std::sin(a));
    }
    return line;
}

/// The letters of what is written here.
Letter letter(char c) {
    constexpr double kMiddle = -0.33, kRadius = 0.33, kTop = -0.66;  // of small letters
    const Line bowl = arc(0.28, kMiddle, 0.28, kRadius, 0, 360);
    switch (c) {
        case 'a':
            return {0.56, {bowl, {{0.56, kTop}, {0.56, 0}}}};
        case 'c':
            return {0.50, {arc(0.28, kMiddle, 0.28, kRadius, 42, 318)}};
        case 'i':
            return {0.0, {{{0, kTop}, {0, 0}}, {{0, -0.93}, {0, -0.91}}}};
        case 'n': {
            Line arch = arc(0.25, -0.41, 0.25, 0.25, 180, 360);
            arch.emplace_back(0.50, 0);
            return {0.50, {{{0, kTop}, {0, 0}}, arch}};
        }
        case 'o':
            return {0.56, {bowl}};
        case 't': {
            Line stem{{0.14, -0.92}};
            const Line foot = arc(0.32, -0.16, 0.18, 0.16, 180, 80);
            stem.insert(stem.end(), foot.begin(), foot.end());
            return {0.36, {stem, {{0, kTop}, {0.34, kTop}}}};
        }
        case 'v':
            return {0.52, {{{0, kTop}, {0.26, 0}, {0.52, kTop}}}};
        case '0':
            return {0.60, {arc(0.30, -0.5, 0.30, 0.5, 0, 360)}};
        case '1':
            return {0.26, {{{0, -0.78}, {0.26, -1.0}, {0.26, 0}}}};
        default:
            return {0.4, {}};
    }
}

double distance_to(const Line& line, const Vec2& p) {
    double best = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 along = line[i + 1] - line[i];
        const double t = std::clamp((p - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - line[i] - t * along).norm());
    }
    return best;
}

/// Straight alpha, over.
void blend(std::uint8_t* pixel, const Vec3& srgb, double cover) {
    const double under = pixel[3] / 255.0 * (1 - cover), alpha = cover + under;
    if (alpha <= 0) return;
    for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(
            std::lround((255 * srgb[k] * cover + pixel[k] * under) / alpha));
    pixel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
}

Vec3 srgb_of(const Vec3& linear) {
    return linear.unaryExpr(
        [](double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; });
}

/// As the shaders show it where light and view come straight on.
Vec3 under_skin(const Vec3& muscle, const Look& look) {
    const Vec3 x =
        (1 - kSkinOverMuscles) * muscle + kSkinOverMuscles * linear_from_srgb(look.skin_tone);
    return x.unaryExpr([](double c) {  // film() of shader_lighting.cpp
        return std::min(1.0, c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14));
    });
}

double width_of(std::string_view text) {
    double width = -kGap;
    for (const char c : text) width += letter(c).width + kGap;
    return width;
}

/// With a soft rim of the other tone, so that it can be read on anything. `at`: its lower left corner, px.
void write(std::string_view text, Vec2 at, double height_px, double ink, Image& image) {
    const double half = std::max(0.55, 0.5 * kStroke * height_px), rim = 0.10 * height_px + 0.6;
    for (const char c : text) {
        const Letter shape = letter(c);
        const int reach = static_cast<int>(std::ceil(half + rim)) + 1;
        const int left = static_cast<int>(at.x()) - reach,
                  top = static_cast<int>(at.y() - height_px) - reach;
        const int right = static_cast<int>(at.x() + shape.width * height_px) + reach;
        const int bottom = static_cast<int>(at.y()) + reach;
        for (int y = std::max(0, top); y <= std::min(bottom, image.height_px - 1); ++y)
            for (int x = std::max(0, left); x <= std::min(right, image.width_px - 1); ++x) {
                const Vec2 p = (Vec2(x + 0.5, y + 0.5) - at) / height_px;
                double d = 1e9;
                for (const Line& line : shape.lines) d = std::min(d, distance_to(line, p));
                d *= height_px;
                std::uint8_t* pixel = image.pixel(x, y);
                blend(pixel, Vec3::Constant(1 - ink),
                      0.35 * std::clamp((half + rim - d) / rim, 0.0, 1.0));
                blend(pixel, Vec3::Constant(ink), std::clamp(half - d + 0.5, 0.0, 1.0));
            }
        at.x() += (shape.width + kGap) * height_px;
    }
}

}  // namespace

void draw_activation_scale(const Look& look, const Background& background, Image& image) {
    const double side = std::min(image.width_px, image.height_px);
    const double letters = kLetterHeight * side;
    const bool written = letters >= kLeastLetter_px;
    const double luminance =
        background.transparent
            ? 0.0
            : 0.2126 * background.rgb[0] + 0.7152 * background.rgb[1] + 0.0722 * background.rgb[2];
    const double ink = luminance > 0.55 ? 0.08 : 0.96;

    const int left = static_cast<int>(std::lround(kMargin * side));
    const int top = left + static_cast<int>(std::lround(written ? 1.6 * letters : 0.0));
    const int length = std::max(8, static_cast<int>(std::lround(kBarLength * side)));
    const int height = std::max(2, static_cast<int>(std::lround(kBarHeight * side)));
    for (int x = 0; x < length && left + x < image.width_px; ++x) {
        const Vec3 colour = srgb_of(under_skin(activation_colour((x + 0.5) / length), look));
        for (int y = 0; y < height && top + y < image.height_px; ++y)
            blend(image.pixel(left + x, top + y), colour, 1);
    }
    if (!written) return;
    const double below = top + height + 1.5 * letters;
    write("activation", {left, left + letters}, letters, ink, image);
    write("0", {left, below}, letters, ink, image);
    write("1", {left + length - width_of("1") * letters, below}, letters, ink, image);
}

}  // namespace risorius::render
