// SPDX-License-Identifier: MIT
/// \file
/// Lines and marks over a finished picture, hidden behind the head.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/surface_passes.h"

namespace risorius::render {

/// Edges of a mesh as thin lines, paler where they are dense.
void draw_wire(const std::vector<std::array<int, 2>>& edges, const SurfacePasses& passes,
               const SeenSurface& seen, Image& image);

struct NamedPoint {
    std::string name;
    Vec3 at;  ///< world, m
};

/// Dots, with their names when the picture is large enough to read them.
void draw_landmarks(const std::vector<NamedPoint>& points, const SurfacePasses& passes,
                    const SeenSurface& seen, Image& image);

}  // namespace risorius::render
