// SPDX-License-Identifier: MIT
/// \file
/// A closed mesh as an obstacle. Its exact signed distance is sampled on a grid and interpolated by cubic splines. So a query
/// takes the same time for any mesh, and the gap has two continuous derivatives.
///
/// Between grid points, the error of the gap is about a thousandth of the width of a cell where the surface is smooth. Sharp
/// edges become rounded; there the error is about a fifth of this width.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "risorius/contact/obstacle.h"
#include "risorius/core/types.h"

namespace risorius::contact {

/// Resolution and extent of the grid.
struct DistanceFieldOptions {
    int cells = 40;  ///< along the longest side of the mesh     [4, 400]
    /// The grid extends beyond the bounding box of the mesh by at least this distance, and by at least 3 cells   [0, inf)
    double margin_m = 0;
};

/// The sampled distance of one mesh.
class DistanceField : public Shape {
  public:
    /// Throws Error for surfaces that are not closed (see ClosedSurface) and for options outside their ranges.
    DistanceField(const Points& positions, const Triangles& triangles,
                  const DistanceFieldOptions& options = {}, const std::string& place = "mesh");

    /// Gap and gradient at p, m. Outside the grid the gap is approximate; it is never less than the margin.
    Distance distance(const Vec3& p) const override;
    Mat3 curvature(const Vec3& p) const override;

    double spacing_m() const { return spacing_; }

  private:
    struct Cell;  // the cell at a point, and the values of the splines there
    Cell cell_of(const Vec3& p) const;
    double coefficient(int i, int j, int k) const {
        return coefficients_[static_cast<std::size_t>((i * size_[1] + j) * size_[2] + k)];
    }

    Vec3 low_, high_;  // corners of the grid
    double spacing_;
    int size_[3];  // number of coefficients per axis: the grid points plus one at either end
    std::vector<double> coefficients_;
};

/// A DistanceField as a shape for an Obstacle. Throws Error as the constructor of DistanceField does.
std::shared_ptr<const Shape> make_mesh(const Points& positions, const Triangles& triangles,
                                       const DistanceFieldOptions& options = {},
                                       const std::string& place = "mesh");

}  // namespace risorius::contact
