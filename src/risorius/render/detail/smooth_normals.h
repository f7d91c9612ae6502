// SPDX-License-Identifier: MIT
/// \file
/// Normals of a deforming surface: area-weighted means over the triangles around each vertex.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Vertices that share a rest position, and look the same way there, share a normal, so that the seams of a file do not show;
/// lips that touch look opposite ways and stay apart.
class SmoothNormals {
  public:
    SmoothNormals(const Points& rest, const std::vector<const Triangles*>& surfaces);

    /// Three floats per vertex, unit length (zero where a vertex has no area around it).
    void compute(const std::vector<float>& positions, std::vector<float>& normals);

  private:
    std::vector<int> corners_;       ///< 3 per triangle
    std::vector<int> around_begin_;  ///< V + 1
    std::vector<int> around_;        ///< triangles around a vertex and around those it is welded to
    std::vector<float> face_normals_;  ///< 3 per triangle, twice the area long
};

}  // namespace risorius::render
