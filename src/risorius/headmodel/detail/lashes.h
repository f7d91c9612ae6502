// SPDX-License-Identifier: MIT
/// \file
/// Lashes: one ribbon along each lid margin that curves away from the eye. The renderer draws single hairs on it.
#pragma once

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {

/// `side` +1 left, -1 right. Lengths: upper 8 mm, lower 5 mm in the middle of the lid, shorter to the canthi (own design).
geom::PolygonMesh lashes(const Skin& skin, const Globe& globe, double side,
                         const std::string& group);

}  // namespace risorius::headmodel
