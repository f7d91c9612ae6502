// SPDX-License-Identifier: MIT
/// \file
/// Draws lines and marks over a finished picture. Their parts that lie behind the head are hidden.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/surface_passes.h"

namespace risorius::render {

/// Draws the edges of a mesh as thin lines, which are paler where they are dense. `edges`: pairs of vertices. `seen`: the pose of
/// the picture, rasterized by `passes`.
void draw_wire(const std::vector<std::array<int, 2>>& edges, const SurfacePasses& passes,
               const SeenSurface& seen, Image& image);

/// A point with a name.
struct NamedPoint {
    std::string name;
    Vec3 at;  ///< world, m
};

/// Draws the points as dots. Their names are added when the picture is large enough to read them.
void draw_landmarks(const std::vector<NamedPoint>& points, const SurfacePasses& passes,
                    const SeenSurface& seen, Image& image);

}  // namespace risorius::render
