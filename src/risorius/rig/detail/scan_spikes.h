// SPDX-License-Identifier: MIT
/// \file
/// Finds spikes behind the lips: points that a scanner saw deep in the mouth, between the lips, on a surface without a mouth.
#pragma once

#include "risorius/rig/detail/lip_line.h"

namespace risorius::rig {

/// The vertices of the head, V x 3, with the points of spikes moved back between their neighbours on the lips; `count` receives
/// their number.
Points without_spikes(const Head& head, const LipLine& line, int& count);

}  // namespace risorius::rig
