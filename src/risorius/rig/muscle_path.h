// Paths of the muscle table laid into a placed head.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// Where a point of a path is on this head at rest, m: on the skin (or near it) for a point with a depth, on the path itself for
/// one without. Throws Error naming the muscle for a landmark that the head does not have.
Vec3 place_on(const Head& head, const PathPoint& point, const std::string& muscle);

}  // namespace risorius::rig
