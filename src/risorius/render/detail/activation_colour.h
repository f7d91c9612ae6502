// The colour of a muscle by its activation: from the deep red-brown of flesh at rest through orange to a clear yellow.
//
// CIE lightness grows evenly with activation, so more active reads as brighter in grey and without colour vision too.
#pragma once

#include "risorius/core/types.h"

namespace risorius::render {

/// Linear light, sRGB primaries, 0..1; `activation` is taken as 0..1, beyond as its ends.
Vec3 activation_colour(double activation);

}  // namespace risorius::render
