// SPDX-License-Identifier: MIT
/// \file
/// The zero surface of a field on a grid, as triangles. The method is naive surface nets (Gibson 1998): one vertex in each cell
/// that the surface crosses, at the mean of the surface's crossings of the cell's edges.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Samples of a field, negative inside. The index of a sample is (k * size[1] + j) * size[0] + i.
struct GridField {
    std::array<int, 3> size{0, 0, 0};  ///< samples along x, y, z
    Vec3 origin = Vec3::Zero();        ///< of the first sample, m
    double step_m = 0;
    std::vector<float> values;

    GridField() = default;
    /// A grid that covers the box; all samples are `value`.
    GridField(const Vec3& low, const Vec3& high, double step_m, float value);

    std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(i);
    }
    Vec3 place(int i, int j, int k) const { return origin + step_m * Vec3(i, j, k); }
    /// Interpolated between samples. Outside the grid it is the value at the border.
    double at(const Vec3& p) const;
};

/// The surface as triangles.
struct NetSurface {
    Points vertices;      ///< V x 3, m
    Triangles triangles;  ///< F x 3, counter-clockwise as seen from where the field is positive
};
NetSurface surface_net(const GridField& field);

}  // namespace risorius::geom
