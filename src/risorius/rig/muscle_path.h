// SPDX-License-Identifier: MIT
/// \file
/// Places points of muscle paths on a head.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::rig {

/// Returns the position of a point of a path on this head at rest, head frame, m. For a point with a depth, this is the point of
/// the skin above the path; for a point without one, it is the point of the path itself. Throws Error naming the muscle when the
/// head lacks a landmark.
Vec3 place_on(const Head& head, const PathPoint& point, const std::string& muscle);

}  // namespace risorius::rig
