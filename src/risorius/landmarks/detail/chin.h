// SPDX-License-Identifier: MIT
/// \file
/// The menton, the lowest point of the chin. Below a chin the skin is flat or falls on towards the neck, so that "lowest" says
/// little. What says more is the way along the profile from the pogonion: it is long where the chin is high and the throat far.
#pragma once

#include <optional>

#include "risorius/landmarks/detail/shown_head.h"

namespace risorius::landmarks {

/// Landmarks of the midline, m, as the comparison with known heads puts them.
struct ChinLandmarks {
    Vec3 sublabiale, pogonion, menton, hyoid;
};

/// Not farther than 7 mm from where the comparison puts it. Returns nothing where the profile of the chin is interrupted.
std::optional<Vec3> menton_by_profile(const ShownHead& head, const ChinLandmarks& at);

}  // namespace risorius::landmarks
