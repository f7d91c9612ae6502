// SPDX-License-Identifier: MIT
/// \file
/// Triangles whose vertices change in every picture, in a vertex array of their own.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"

namespace risorius::render {

class StreamedTriangles {
  public:
    /// `sizes`: number of floats of each vertex attribute, by location; the first attribute is the position, m. The context must
    /// be current.
    StreamedTriangles(const std::vector<unsigned>& indices, std::initializer_list<int> sizes);
    ~StreamedTriangles();
    StreamedTriangles(const StreamedTriangles&) = delete;
    StreamedTriangles& operator=(const StreamedTriangles&) = delete;

    /// Uploads the floats of all vertices, one vertex after the other. There must be as many vertices as the indices name.
    void upload(std::vector<float> vertices);
    /// Returns an empty vector to fill and to upload. It is that of the last upload, so that its memory is used again.
    std::vector<float> take();

    /// Blends over the picture without writing depth, with the current blend function and program. Binds its own vertex array.
    void draw() const;
    /// Marks the cells that the triangles cover in this clip space as needing samples.
    void mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const;

  private:
    std::vector<unsigned> indices_;
    std::size_t floats_ = 0;  ///< per vertex
    std::vector<float> vertices_;
    GLuint array_ = 0, buffer_ = 0, elements_ = 0;
};

}  // namespace risorius::render
