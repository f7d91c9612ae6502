// SPDX-License-Identifier: MIT
/// \file
/// Estimates missing landmarks. The atlas is warped to fit the given ones, and its other landmarks are projected onto the skin. A
/// point on the margin of a lip is projected onto that lip only, because the other lip touches it.
#pragma once

#include <map>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// `given`: landmarks of the atlas in the head frame, m. They must include stomion and both midline points of the vermilion
/// border. `skin` must be welded. `size`: size of this head over that of the atlas head. Returns all other landmarks.
std::map<std::string, Vec3> missing_landmarks(const Points& vertices, const Triangles& skin,
                                              const Atlas& atlas,
                                              const std::map<std::string, Vec3>& given,
                                              double size);

}  // namespace risorius::rig
