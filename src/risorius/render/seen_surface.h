// SPDX-License-Identifier: MIT
/// \file
/// The nearest triangle of a surface in each pixel, by a rasterizer in software without OpenGL. The bytes are the same on every
/// machine.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// A rasterized pose: per pixel, rows from the top, the nearest triangle and the point on it.
struct SeenSurface {
    Points positions;           ///< V x 3, m, world
    std::vector<int> triangle;  ///< -1: background
    /// Barycentric weights of the second and third corner of the triangle
    std::vector<float> second, third;
    /// Depth in clip space after division by w; it grows with distance, in spite of its name: -1 nearest, 1 farthest, 2 for the
    /// background
    std::vector<float> nearness;
};

/// Rasterizes triangles, one sample at the centre of each pixel. `clip_from_world`: as of OffscreenView::clip_from_world().
SeenSurface see_surface(const Points& positions, const Triangles& triangles,
                        const Eigen::Matrix4d& clip_from_world, int width_px, int height_px);

}  // namespace risorius::render
