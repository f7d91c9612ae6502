// SPDX-License-Identifier: MIT
/// \file
/// Finds spikes behind the lips. A scanner sees some points deep in the mouth between the lips; in a mesh without a mouth they
/// are spikes of the skin.
#pragma once

#include "risorius/rig/detail/lip_line.h"

namespace risorius::rig {

/// Returns the vertices of the head, V x 3, in which the points of spikes are moved back between their neighbours on the lips.
/// `count` receives the number of these points.
Points without_spikes(const Head& head, const LipLine& line, int& count);

}  // namespace risorius::rig
