// SPDX-License-Identifier: MIT
/// \file
/// Places points of muscle paths on a head.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// Position of a point of a path on this head at rest, m. A point with a depth lies on or near the skin; a point without one lies
/// on the path itself. Throws Error naming the muscle when the head lacks a landmark.
Vec3 place_on(const Head& head, const PathPoint& point, const std::string& muscle);

}  // namespace risorius::rig
