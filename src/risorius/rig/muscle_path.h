// SPDX-License-Identifier: MIT
/// \file
/// Places the paths of the muscle table in a head.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// Position of a point of a path on this head at rest, m. For a point with a depth it lies on or near the skin, for a point without one
/// on the path itself. Throws Error that names the muscle when the head lacks a landmark.
Vec3 place_on(const Head& head, const PathPoint& point, const std::string& muscle);

}  // namespace risorius::rig
