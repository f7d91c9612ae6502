// SPDX-License-Identifier: MIT
/// \file
/// The buffer of a surface that moves: positions and smooth normals.
#pragma once

#include <string>
#include <vector>

#include "risorius/render/detail/gl.h"
#include "risorius/render/detail/smooth_normals.h"

namespace risorius::render {

class MovingSurface {
  public:
    /// The context must be current.
    MovingSurface(const Points& rest, const std::vector<const Triangles*>& surfaces);
    ~MovingSurface();
    MovingSurface(const MovingSurface&) = delete;
    MovingSurface& operator=(const MovingSurface&) = delete;

    /// As the attributes kPosition and kNormal of the vertex array that is bound.
    void attach() const;

    /// Positions, m, one row per vertex; throws Error with the place for another number of them.
    void upload(const Points& positions, const std::string& place);

  private:
    Eigen::Index vertex_count_;
    SmoothNormals smooth_;
    std::vector<float> positions_, normals_, moving_;
    GLuint buffer_ = 0;
};

}  // namespace risorius::render
