// SPDX-License-Identifier: MIT
/// \file
/// The GL buffer of a moving surface: positions and smooth normals.
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

    /// Attaches the buffer to the attributes kPosition and kNormal of the bound vertex array.
    void attach() const;

    /// Uploads positions, m, one row per vertex. Throws Error for another number of rows; the message begins with `place`.
    void upload(const Points& positions, const std::string& place);

  private:
    Eigen::Index vertex_count_;
    SmoothNormals smooth_;
    std::vector<float> positions_, normals_, moving_;
    GLuint buffer_ = 0;
};

}  // namespace risorius::render
