// Lashes: one ribbon along each lid margin, standing on it and curving away from the eye. A renderer cuts the single hairs.
#pragma once

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {

/// `side` +1 left, -1 right. Lengths: upper 8 mm, lower 5 mm in the middle of the lid, shorter to the canthi (own design).
geom::PolygonMesh lashes(const Skin& skin, const Globe& globe, double side,
                         const std::string& group);

}  // namespace risorius::headmodel
