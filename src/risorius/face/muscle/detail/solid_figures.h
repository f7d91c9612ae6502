// SPDX-License-Identifier: MIT
/// \file
/// Measures of one side of a volume muscle.
#pragma once

#include <string>

#include "risorius/core/types.h"

namespace risorius::face {

/// Each ratio is the current value / the value at rest.
struct SolidFigures {
    std::string muscle;
    Side side = Side::kLeft;
    double volume_ratio = 1;     ///< of the whole muscle
    double min_cell_ratio = 1;   ///< minimum over its cells of the volume
    double mean_stretch = 1;     ///< mean over its fibres of the length
    double thickness_ratio = 1;  ///< of the middle section
};

}  // namespace risorius::face
