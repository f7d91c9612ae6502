// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/lip_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace risorius::landmarks {

namespace {

// Measured on ICT-FaceKit, MakeHuman, the adult and people of its family: docs/decisions/0091. In the midline, the lips turn by 79 degrees
// or more, the crease above the chin by up to 94.
constexpr double kMiddleAround_m = 12e-3, kMiddlePrice_deg_per_m = 2e3, kMiddle_deg = 60;
constexpr double kFollowAround_m = 0.8e-3, kFollowPrice_deg_per_m = 3e4, kFlat_deg = 3;
constexpr double kCorner_deg = 45;  // where the lips turn by less, they have met
constexpr int kWithoutLips = 5;     // so many columns without lips end the line
constexpr std::size_t kSlopeColumns = 7;
constexpr double kNarrowest_m = 8e-3, kWidest_m = 42e-3;  // half of a mouth

std::optional<Vec3> corner_of_lips(const FrontRays& rays, const Crease& middle, double x,
                                   double outwards) {
    std::vector<double> heights;
    Vec3 place = *middle.at, corner = place;
    int without = 0;
    for (int i = 0; without < kWithoutLips; ++i) {
        if (i * kRayStep_m > kWidest_m) return std::nullopt;
        double expected = heights.empty() ? middle.y : heights.back();
        if (heights.size() > kSlopeColumns)
            expected += (heights.back() - heights[heights.size() - 1 - kSlopeColumns]) /
                        static_cast<double>(kSlopeColumns);
        const Crease here = rays.crease({x + outwards * i * kRayStep_m, expected, kFollowAround_m,
                                         kFollowPrice_deg_per_m, place.z(), kFlat_deg});
        if (here.turn_deg < kCorner_deg) {
            ++without;
            heights.push_back(expected);
            continue;
        }
        without = 0;
        heights.push_back(here.y);
        if (here.at) corner = place = *here.at;
    }
    if (std::abs(corner.x() - x) < kNarrowest_m) return std::nullopt;
    return corner;
}

}  // namespace

std::optional<LipLine> find_lip_line(const FrontRays& rays, const Vec3& guess) {
    const Crease middle = rays.crease(
        {guess.x(), guess.y(), kMiddleAround_m, kMiddlePrice_deg_per_m, guess.z(), kFlat_deg});
    if (middle.turn_deg < kMiddle_deg || !middle.at) return std::nullopt;
    return LipLine{*middle.at, corner_of_lips(rays, middle, guess.x(), 1),
                   corner_of_lips(rays, middle, guess.x(), -1)};
}

}  // namespace risorius::landmarks
