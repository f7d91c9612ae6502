// Points of a scan that were seen between the lips, deep in the mouth, on a surface that has no mouth: spikes from the lips
// backwards.
#pragma once

#include "risorius/rig/detail/lip_line.h"

namespace risorius::rig {

/// The head's vertices, V x 3, with such points laid back between their neighbours on the lips; `count` of them.
Points without_spikes(const Head& head, const LipLine& line, int& count);

}  // namespace risorius::rig
