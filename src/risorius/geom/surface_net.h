// SPDX-License-Identifier: MIT
/// \file
/// Makes triangles of the surface on which a field, sampled on a grid, is zero. The method is naive surface nets (Gibson 1998).
/// Each cell of the grid that the surface crosses gets one vertex, at the mean of the points where the surface crosses the edges
/// of the cell.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Samples of a field, negative inside. The index of a sample is (k * size[1] + j) * size[0] + i.
struct GridField {
    std::array<int, 3> size{0, 0, 0};  ///< samples along x, y, z
    Vec3 origin = Vec3::Zero();        ///< position of the first sample, m
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
    /// Returns the field at p, m, interpolated between samples. Outside the grid, it is the value at the nearest point of the
    /// border.
    double at(const Vec3& p) const;
};

/// The surface as triangles.
struct NetSurface {
    Points vertices;      ///< V x 3, m
    Triangles triangles;  ///< F x 3, counter-clockwise as seen from where the field is positive
};
NetSurface surface_net(const GridField& field);

}  // namespace risorius::geom
