// SPDX-License-Identifier: MIT
/// \file
/// Estimates landmarks that were not given: the atlas is warped through those that were, and the points are projected onto the skin.
/// Points on the margin of a lip are projected onto that lip only, since the other lip touches it.
#pragma once

#include <map>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// `given`: landmarks of the atlas in the head frame, m; stomion and both midline points of the vermilion border must be among them.
/// Returns all others. `skin` is welded; `size` is the size of this head / that of the atlas head.
std::map<std::string, Vec3> missing_landmarks(const Points& vertices, const Triangles& skin,
                                              const Atlas& atlas,
                                              const std::map<std::string, Vec3>& given,
                                              double size);

}  // namespace risorius::rig
