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
    out.nose = std::exp(much * 0.25 * around_zero());
    const double pigment = 0.16 * around_zero(), blood = 0.14 * around_zero();
    out.lips = (-much * Vec3(pigment, pigment + blood, pigment + 0.9 * blood)).array().exp();
    out.brows = std::exp(much * 0.3 * std::clamp(around_zero(), -1.5, 1.0));
    out.lashes = std::exp(much * 0.35 * around_zero());
    const double many = random.next();
    out.moles = static_cast<int>(much * 7 * many * many);
    for (double* factor : {&out.eyes, &out.cheeks}) *factor = std::min(*factor, 2.2);
    // Three zones of the nose lie over each other. Who is not mottled looks as before there were mottles.
    out.nose = std::min(out.nose, appearance.mottling > 0 ? 1.3 : 2.2);
    return out;
}

}  // namespace risorius::render
