// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/part_layout.h"

#include <cmath>

namespace risorius::headmodel {

Vec2 Disc::at(double fraction, double angle) const {
    return middle + radius * fraction * Vec2(turn * std::cos(angle), std::sin(angle));
}

Disc eye_disc(double side) { return {.turn = side}; }

Disc crown_disc(bool upper, int crown) {
    constexpr int kColumns = 6, kOfAnArch = 14;
    constexpr double kCell = 1.0 / kColumns;
    const int cell = crown + (upper ? 0 : kOfAnArch);
    const bool left = crown < kOfAnArch / 2;
    return {.middle = Vec2((cell % kColumns + 0.5) * kCell, 1 - (cell / kColumns + 0.5) * kCell),
            .radius = 0.46 * kCell,
            .turn = left == upper ? 1.0 : -1.0};
}

Disc tongue_disc() { return {}; }

Vec2 gum_place(bool upper, double along, double around) {
    constexpr double kMargin = 0.01, kHeight = 0.5 - 2 * kMargin;
    // Seen from the lips both run from left to right, and teeth are below the upper one and above the lower one.
    return {kMargin + (1 - 2 * kMargin) * along,
            upper ? 1 - kMargin - kHeight * around : kMargin + kHeight * around};
}

}  // namespace risorius::headmodel
