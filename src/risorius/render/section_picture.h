// SPDX-License-Identifier: MIT
/// \file
/// Draws the section of bodies with a plane: filled areas and lines on paper.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

/// The section of one body: segments in no order, px from the upper left corner of the picture.
struct SectionPart {
    std::vector<std::pair<Vec2, Vec2>> segments;
    Vec3 ink = Vec3::Zero();  ///< sRGB
    double fill =
        0;  ///< opacity of the area inside, 0..1; rows in which the segments do not close have none
    double line_px = 1;
};

/// Replaces the picture by paper with the parts on it, the first one below the others.
void draw_sections(const std::vector<SectionPart>& parts, Image& image);

}  // namespace risorius::render
