// SPDX-License-Identifier: MIT
/// \file
/// What of a person's colours differs from the usual beside its tones: shade around the eyes, blood of cheeks and nose, lips, brows, lashes, moles.
#pragma once

#include "risorius/render/scene.h"

namespace risorius::render {

/// Factors of what is usual.
struct Complexion {
    double eyes = 1;              ///< shade of the skin around the eyes
    double cheeks = 1, nose = 1;  ///< blood under the skin
    double lashes = 1;            ///< width of the lashes
    Vec3 lips{1, 1, 1};           ///< of their linear tone
    double brows = 1;             ///< of the tone of brows and beard
    int moles = 0;
};

/// Drawn from the seed of the appearance; all usual where its `complexion` is 0.
Complexion complexion_of(const Appearance& appearance);

}  // namespace risorius::render
