// SPDX-License-Identifier: MIT
/// \file
/// The menton, the lowest point of the chin. Below a chin the skin is flat or falls on towards the neck, so that "lowest" says
/// little. What says more is the way along the profile from the pogonion, which differs little between heads.
#pragma once

#include <optional>

#include "risorius/landmarks/detail/shown_head.h"

namespace risorius::landmarks {

/// The mean of the guess and of the usual length of the profile, each weighted by how sure it is. `head`: as large as the average adult, m.
/// Returns nothing where the profile of the chin is interrupted.
std::optional<Vec3> menton_near(const ShownHead& head, const Vec3& pogonion, const Vec3& guess);

}  // namespace risorius::landmarks
