// SPDX-License-Identifier: MIT
/// \file
/// Finds points that a scanner saw deep in the mouth, between the lips, on a surface that has no mouth. They form spikes behind the lips.
#pragma once

#include "risorius/rig/detail/lip_line.h"

namespace risorius::rig {

/// The vertices of the head, V x 3, with such points moved back between their neighbours on the lips; `count` is their number.
Points without_spikes(const Head& head, const LipLine& line, int& count);

}  // namespace risorius::rig
