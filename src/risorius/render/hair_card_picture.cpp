// SPDX-License-Identifier: MIT
// The picture of hair cards (hair_cards.h): colour of the strands, and cells whose alpha cuts rims and ends.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/card_picture.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/detail/strand_texture.h"
#include "risorius/render/hair_cards.h"
#include "risorius/render/texture_square.h"

namespace risorius::render {
namespace {

/// What hair of any colour mirrors of the light around it, as a share of white: black hair would be a hole without it.
constexpr double kSheen = 0.010;
constexpr int kCardPictureWidth_px = 2 * kStrandSide, kCardPictureHeight_px = kStrandSide;

/// Draws a strand from the root to `end` (0..1 of the height) into the alpha of a cell. `at`: its middle, px from the left.
void add_card_strand(Image& image, int first_px, int cell_px, double at, double half_px,
                     double bend_px, double end) {
    for (int y = 0; y < image.height_px; ++y) {
        const double t = (y + 0.5) / image.height_px;
        if (t > end) break;
        const double x = at + bend_px * t * t, half = half_px * std::min(1.0, 0.25 + 4 * (end - t));
        for (int dx = static_cast<int>(x - half) - 1; dx <= static_cast<int>(x + half) + 1; ++dx) {
            if (dx < 0 || dx >= cell_px) continue;
            const double covered = std::clamp(half + 0.5 - std::abs(dx + 0.5 - x), 0.0, 1.0);
            std::uint8_t& alpha = image.pixel(first_px + dx, y)[3];
            alpha = std::max(alpha, static_cast<std::uint8_t>(std::lround(255 * covered)));
        }
    }
}

void cut_card_cells(unsigned seed, Image& image) {
    constexpr int kStrands = 30, kCell_px = kCardPictureWidth_px / static_cast<int>(kCardCells);
    RandomSequence random(seed * 7919U + 5U);
    for (std::size_t cell = 0; cell < kCardCells; ++cell) {
        const int first = static_cast<int>(cell) * kCell_px;
        for (int y = 0; y < static_cast<int>(kCardBody * image.height_px); ++y)
            for (int x = static_cast<int>(kCardRim * kCell_px);
                 x < static_cast<int>((1 - kCardRim) * kCell_px); ++x)
                image.pixel(first + x, y)[3] = 255;
        for (int i = 0; i < kStrands; ++i) {
            const double at = (i + random.next()) * kCell_px / kStrands,
                         half = 0.9 + 1.1 * random.next(), bend = 6 * (random.next() - 0.5);
            // Strands at the rims end anywhere, the others at the end of the card.
            const double aside = std::abs(2 * at / kCell_px - 1), chance = random.next();
            const double end =
                aside > 1 - kCardRim ? 0.45 + 0.5 * chance : kCardBody + (1 - kCardBody) * chance;
            add_card_strand(image, first, kCell_px, at, half, bend, end);
        }
    }
}

}  // namespace

Image hair_card_picture(const Appearance& appearance) {
    const double share = white_share(appearance);
    const std::vector<std::uint8_t> strands = strand_texels(appearance.seed, share);
    const Vec3 tone = linear_from_srgb(appearance.hair_tone).cwiseSqrt(),
               white = linear_from_srgb(kWhiteHair).cwiseSqrt();
    // Few levels of brightness make a small file.
    constexpr int kLevels = 32;
    const auto level = [](std::uint8_t value) {
        return std::round(value * (kLevels - 1) / 255.0) / (kLevels - 1);
    };
    Image image(kCardPictureWidth_px, kCardPictureHeight_px);
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            const std::uint8_t* strand = &strands[2 * (static_cast<std::size_t>(y) * kStrandSide +
                                                       static_cast<std::size_t>(x % kStrandSide))];
            // As shader_lock.cpp has it, under light from all around
            const double hair = level(strand[0]), bright = hair + hair * hair;
            const Vec3 root = tone + level(strand[1]) * (white - tone);
            for (int k = 0; k < 3; ++k)
                image.pixel(x, y)[k] = srgb_byte(std::min(
                    kMostHairTone * (root[k] * root[k] * (0.25 + 1.1 * bright) + kSheen * bright),
                    1.0));
        }
    cut_card_cells(appearance.seed, image);
    return image;
}

}  // namespace risorius::render
