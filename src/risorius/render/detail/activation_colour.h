// SPDX-License-Identifier: MIT
/// \file
/// The colour of a muscle by its activation: from dark red-brown at rest through orange to yellow.
///
/// CIE lightness is linear in activation, so a more active muscle is also brighter in greyscale and for colour-blind viewers.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Returns the colour in linear light with sRGB primaries, 0..1. `activation` is clamped to 0..1.
Vec3 activation_colour(double activation);

}  // namespace risorius::render
