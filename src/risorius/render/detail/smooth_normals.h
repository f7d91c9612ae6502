// SPDX-License-Identifier: MIT
/// \file
/// Normals of a deforming surface: area-weighted means over the triangles around each vertex.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Vertices with the same rest position and similar normals there share one normal, so seams of a mesh file do not show. Lips
/// that touch have opposite normals and stay separate.
class SmoothNormals {
  public:
    SmoothNormals(const Points& rest, const std::vector<const Triangles*>& surfaces);

    /// Computes the unit normal of each vertex, three floats; zero where the triangles around a vertex have no area. `positions`:
    /// three floats per vertex, m.
    void compute(const std::vector<float>& positions, std::vector<float>& normals);

  private:
    std::vector<int> corners_;       ///< 3 per triangle
    std::vector<int> around_begin_;  ///< V + 1
    std::vector<int> around_;  ///< triangles around a vertex and around the vertices welded to it
    std::vector<float> face_normals_;  ///< 3 per triangle, scaled by twice the area
};

}  // namespace risorius::render
