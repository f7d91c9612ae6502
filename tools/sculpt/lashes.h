// Lashes: thin tapering strips that stand on the lid margin and curve away from the eye.
#pragma once

#include "skin.h"

namespace risorius::sculpt {

/// `side` +1 left, -1 right. Lengths: upper 8 mm, lower 5 mm in the middle of the lid, shorter to the canthi (own design).
geom::PolygonMesh lashes(const Skin& skin, const Globe& globe, double side, const std::string& group);

}  // namespace risorius::sculpt
