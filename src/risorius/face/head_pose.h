// SPDX-License-Identifier: MIT
/// \file
/// How the head is turned and moved, without a simulation.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// Returns the motion of the head from rest that the channels of a drive ask for. Points of the skull follow all of it.
Rigid head_pose(const rig::Head& head, const track::Drive& drive);

}  // namespace risorius::face
