// Landmarks that were not given: the atlas warped through those that were, then dropped on the skin. Margins of the lips are
// dropped on their own lip, as the other one touches it.
#pragma once

#include <map>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// `given` holds landmarks of the atlas in the head frame, m, stomion and both midline vermilion borders among them; the
/// answer holds all that were not. `skin` is welded; `size` of this head over the atlas head.
std::map<std::string, Vec3> missing_landmarks(const Points& vertices, const Triangles& skin,
                                              const Atlas& atlas,
                                              const std::map<std::string, Vec3>& given,
                                              double size);

}  // namespace risorius::rig
