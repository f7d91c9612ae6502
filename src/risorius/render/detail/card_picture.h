// SPDX-License-Identifier: MIT
/// \file
/// How the picture of hair cards (hair_cards.h) is laid out. It is a row of cells; each has the strands of one card from root, at
/// the top, to end.
#pragma once

#include <cstddef>

namespace risorius::render {

constexpr std::size_t kCardCells = 8;
constexpr double kCardRim = 0.14;   ///< share of a cell at either side where single strands are
constexpr double kCardBody = 0.70;  ///< share of a cell from the root, where it is whole
/// Width on a head of the texture of strands (strand_texture.h), and of this picture, which has it twice, m
constexpr double kStrandTexture_m = 0.050, kCardPicture_m = 0.100;
/// The lightest lock has this factor of the tone of the hair; the picture has it, so that factors of the picture are below 1.
constexpr double kMostHairTone = 1.27;

}  // namespace risorius::render
