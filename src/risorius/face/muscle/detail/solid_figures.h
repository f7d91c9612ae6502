// SPDX-License-Identifier: MIT
/// \file
/// Measures of one side of a volume muscle.
#pragma once

#include <string>

#include "risorius/core/types.h"

namespace risorius::face {

/// Ratios of now to rest.
struct SolidFigures {
    std::string muscle;
    Side side = Side::kLeft;
    double volume_ratio = 1;     ///< of the whole muscle
    double min_cell_ratio = 1;   ///< minimum over the volumes of its cells
    double mean_stretch = 1;     ///< mean over the lengths of its fibres
    double thickness_ratio = 1;  ///< of the middle section
};

}  // namespace risorius::face
