// SPDX-License-Identifier: MIT
#include "risorius/render/detail/complexion.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/counter_rng.h"

namespace risorius::render {

// Estimates: no tables of these were found. Shade below the eyes grows with the years.
Complexion complexion_of(const Appearance& appearance) {
    Complexion out;
    const double much = appearance.complexion;
    if (much <= 0) return out;
    RandomSequence random(appearance.seed * 5003U + 29U);
    const auto around_zero = [&] {
        double sum = -3;
        for (int k = 0; k < 3; ++k) sum += 2 * random.next();
        return sum;
    };
    out.eyes = std::exp(much * (0.45 * around_zero() + 0.5 * appearance.age));
    out.cheeks = std::exp(much * 0.35 * around_zero());
    out.nose = std::exp(much * (0.25 * around_zero() - 0.45));
    const double pigment = 0.16 * around_zero(), blood = 0.14 * around_zero();
    out.lips = (-much * Vec3(pigment, pigment + blood, pigment + 0.9 * blood)).array().exp();
    out.brows = std::exp(much * 0.3 * std::clamp(around_zero(), -1.5, 1.0));
    out.lashes = std::exp(much * (0.12 + 0.35 * around_zero()));
    const double many = random.next();
    out.moles = static_cast<int>(much * 7 * many * many);
    // Three zones of the nose lie over each other; more would look like a cold.
    out.eyes = std::min(out.eyes, 2.2);
    out.cheeks = std::min(out.cheeks, 1.75);
    out.nose = std::min(out.nose, 1.0);
    return out;
}

}  // namespace risorius::render
