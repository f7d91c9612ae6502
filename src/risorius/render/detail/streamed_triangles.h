// SPDX-License-Identifier: MIT
/// \file
/// Triangles whose vertices are new in every picture, in a vertex array of their own.
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
    /// Floats of each attribute of a vertex, by location; the first is its place, m. The context must be current.
    StreamedTriangles(const std::vector<unsigned>& indices, std::initializer_list<int> sizes);
    ~StreamedTriangles();
    StreamedTriangles(const StreamedTriangles&) = delete;
    StreamedTriangles& operator=(const StreamedTriangles&) = delete;

    /// Takes the vertices one after another, as many as the indices name.
    void upload(std::vector<float> vertices);
    /// The vertices of last time, emptied, to be filled and uploaded again.
    std::vector<float> take();

    /// Blended over what is there without hiding what comes later, by the blend function that was set; the program is the caller's. Binds
    /// the own vertex array.
    void draw() const;
    /// The cells that it lies in, seen through this clip space, need samples.
    void mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const;

  private:
    std::vector<unsigned> indices_;
    std::size_t floats_ = 0;  ///< of a vertex
    std::vector<float> vertices_;
    GLuint array_ = 0, buffer_ = 0, elements_ = 0;
};

}  // namespace risorius::render
