// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/skin_pigments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/core/srgb.h"

namespace risorius::headmodel {
namespace {

constexpr double kSurface = 0.028;  ///< share of the light that the surface reflects

/// To hundredths of a percent: files stay short.
Vec3 encoded(const Vec3& colour) {
    return colour.unaryExpr([](double c) { return std::round(1e4 * srgb_of_linear(c)) / 1e4; });
}

/// What a matt surface does not mirror it scatters, so that its colour is paler: of the light that it reflects, this share.
Vec3 powdered(const Vec3& skin, double gloss) {
    constexpr double kScattered = 0.6;
    const double paler = kScattered * kSurface * std::max(1 - gloss, 0.0);
    return encoded(skin.unaryExpr([&](double c) { return linear_of_srgb(c) + paler; }));
}

}  // namespace

double typology_angle_deg(const Vec3& tone) {
    // CIELAB under D65 (IEC 61966-2-1, CIE 15): L* = 116 f(Y) - 16, b* = 200 (f(Y) - f(Z))
    const Vec3 colour = tone.unaryExpr([](double c) { return linear_of_srgb(c) + kSurface; });
    const double y = colour.dot(Vec3(0.2126729, 0.7151522, 0.0721750));
    const double z = colour.dot(Vec3(0.0193339, 0.1191920, 0.9503041)) / 1.08883;
    const auto f = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    return std::atan2(116 * f(y) - 66, 200 * (f(y) - f(z))) * 180 / std::numbers::pi;
}

SkinColours skin_colours(const Identity& identity, const DesignTables& tables) {
    constexpr double kCover = 0.8;
    // Darker on darker skin, or it would glow; sRGB
    constexpr double kDarkest = 0.6, kFairSkin = 0.7;
    const Vec3 red(0.55, 0.13, 0.17);
    SkinColours colours;
    if (identity.melanin) {
        colours = skin_colours(*identity.melanin, identity.haemoglobin, tables);
        colours.skin = powdered(colours.skin, identity.hairdo.skin_gloss);
    } else {
        const Vec3& skin = tables.tones.at("skin").at(identity.skin);
        colours = {skin, tables.tones.at("lips").at(identity.skin), typology_angle_deg(skin)};
    }
    const double fair = std::min(colours.skin.mean() / kFairSkin, 1.0);
    if (identity.lipstick > 0)
        colours.lips +=
            kCover * identity.lipstick * ((kDarkest + (1 - kDarkest) * fair) * red - colours.lips);
    return colours;
}

SkinColours skin_colours(double melanin, double haemoglobin, const DesignTables& tables) {
    const auto& rows = tables.skin_pigments;
    std::size_t next = 1;
    while (next + 1 < rows.size() && melanin > rows[next].melanin) ++next;
    const PigmentTone &from = rows[next - 1], &to = rows[next];
    const double t = std::clamp((melanin - from.melanin) / (to.melanin - from.melanin), 0.0, 1.0);
    // Between rows pigments multiply.
    const Vec3 pale = ((1 - t) * from.albedo.array().log() + t * to.albedo.array().log()).exp();
    const double h = haemoglobin * ((1 - t) * from.haemoglobin + t * to.haemoglobin);
    const Vec3 blood = (-h * Vec3(0.42, 1, 0.96)).array().exp();
    const Vec3 caucasian(0.425, 0.241, 0.167), african(0.154, 0.066, 0.032);
    const Vec3 lips_of_caucasian(0.311, 0.112, 0.094), lips_of_african(0.134, 0.061, 0.050);
    const Vec3 exponent = (lips_of_caucasian.array() / lips_of_african.array()).log() /
                          (caucasian.array() / african.array()).log();
    // In darker skin than was measured, lips keep their hue.
    const double darker = std::min(pale.y() / african.y(), 1.0);
    const Vec3 lips = darker < 1 ? Vec3(darker * lips_of_african)
                                 : Vec3(lips_of_caucasian.array() *
                                        (pale.array() / caucasian.array()).pow(exponent.array()));
    const Vec3 cheek = pale.cwiseProduct(blood);
    SkinColours colours{encoded(cheek), encoded(lips.cwiseProduct(blood)), 0};
    colours.ita_deg = typology_angle_deg(colours.skin);
    return colours;
}

}  // namespace risorius::headmodel
