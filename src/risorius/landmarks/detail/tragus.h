// SPDX-License-Identifier: MIT
/// \file
/// The tragion by its definition: the upper end of the tragus, just below the notch between tragus and helix.
///
/// Seen from the side, the tragus is a hill with the pit of the ear behind it. A ridge leads from its summit up to the front root of
/// the helix, and the step from the ridge down into the ear becomes smaller on the way. The tragus ends
/// at the notch; where none is sharp, where half of the step is left.
#pragma once

#include <optional>

#include "risorius/landmarks/detail/shown_head.h"

namespace risorius::landmarks {

struct Tragion {
    Vec3 at;        ///< m, on the skin
    bool at_notch;  ///< the notch is sharp; else the tragus ends where its step is half
};

/// `head`: upright, facing +z, in m, about as large as the average adult. `side`: +1 for the subject's left ear, -1 for the right one.
/// `guess`: where the comparison with other heads puts the tragion. Returns a point of the skin; nothing when there is no tragus near.
std::optional<Tragion> tragion_near(const ShownHead& head, double side, const Vec3& guess);

}  // namespace risorius::landmarks
