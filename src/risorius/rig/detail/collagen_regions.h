// SPDX-License-Identifier: MIT
/// \file
/// Regions of passive fibres in the tissue, such as the superficial musculoaponeurotic system (SMAS) or the lines of the skin. The law
/// is that of tissue/collagen_tets.h.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::rig {

/// A ball around a landmark. Its fibres lie parallel to the skin, in the direction from one landmark to another.
struct CollagenRegion {
    std::string at;              ///< the landmark in its middle
    double radius_mm = 0;        ///< of an average adult; the stiffness fades over the outer fifth
    std::string layer = "both";  ///< "deep", "superficial" or "both"
    std::string from, to;        ///< landmarks
    double k1_pa = 0;            ///< a quarter of the modulus along the fibres at rest
    double k2 = 1;               ///< how fast they stiffen
};

/// Reads the list. `landmarks`: the names that a region may use.
std::vector<CollagenRegion> read_collagen_regions(const JsonCursor& json,
                                                  const std::vector<std::string>& landmarks);
Json collagen_regions_json(const std::vector<CollagenRegion>& regions);

}  // namespace risorius::rig
