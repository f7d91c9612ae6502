// SPDX-License-Identifier: MIT
/// \file
/// A closed mesh as an obstacle: its exact signed distance sampled on a grid and interpolated by cubic splines, so that a
/// query costs the same for any mesh and the gap has two continuous derivatives.
///
/// Between grid points the gap is within about a thousandth of a cell of the exact one where the surface is smooth, and
/// within about a fifth of a cell at sharp edges, which it rounds.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "risorius/contact/obstacle.h"
#include "risorius/core/types.h"

namespace risorius::contact {

struct DistanceFieldOptions {
    int cells = 40;  ///< along the longest side of the mesh     [4, 400]
    double margin_m =
        0;  ///< the field reaches at least this far out of the mesh's box, and 3 cells   [0, inf)
};

class DistanceField : public Shape {
  public:
    /// Throws Error for what is no closed surface (see ClosedSurface) and for options outside their ranges.
    DistanceField(const Points& positions, const Triangles& triangles,
                  const DistanceFieldOptions& options = {}, const std::string& place = "mesh");

    /// Outside the grid a rough gap, at least the margin.
    Distance distance(const Vec3& p) const override;
    Mat3 curvature(const Vec3& p) const override;

    double spacing_m() const { return spacing_; }

  private:
    struct Cell;  // where a point lies and the splines' values there
    Cell cell_of(const Vec3& p) const;
    double coefficient(int i, int j, int k) const {
        return coefficients_[static_cast<std::size_t>((i * size_[1] + j) * size_[2] + k)];
    }

    Vec3 low_, high_;  // of the grid points
    double spacing_;
    int size_[3];  // of the coefficients: one more than the grid points at either end
    std::vector<double> coefficients_;
};

std::shared_ptr<const Shape> make_mesh(const Points& positions, const Triangles& triangles,
                                       const DistanceFieldOptions& options = {},
                                       const std::string& place = "mesh");

}  // namespace risorius::contact
