// SPDX-License-Identifier: MIT
#include "risorius/render/detail/moving_surface.h"

#include "risorius/core/error.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr std::size_t kMovingFloats = 6;

}  // namespace

MovingSurface::MovingSurface(const Points& rest, const std::vector<const Triangles*>& surfaces)
    : vertex_count_(rest.rows()), smooth_(rest, surfaces) {
    glGenBuffers(1, &buffer_);
}

MovingSurface::~MovingSurface() { glDeleteBuffers(1, &buffer_); }

void MovingSurface::attach() const {
    constexpr auto kStride = static_cast<GLsizei>(kMovingFloats * sizeof(float));
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glEnableVertexAttribArray(kPosition);
    glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, kStride, nullptr);
    glEnableVertexAttribArray(kNormal);
    glVertexAttribPointer(kNormal, 3, GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(3 * sizeof(float)));
}

void MovingSurface::upload(const Points& positions, const std::string& place) {
    if (positions.rows() != vertex_count_)
        throw Error(place, std::to_string(vertex_count_) + " rows",
                    std::to_string(positions.rows()));
    const auto vertices = static_cast<std::size_t>(vertex_count_);
    positions_.resize(3 * vertices);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        positions_[i] = static_cast<float>(positions.data()[i]);
    smooth_.compute(positions_, normals_);
    moving_.resize(kMovingFloats * vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) {
            moving_[kMovingFloats * v + k] = positions_[3 * v + k];
            moving_[kMovingFloats * v + 3 + k] = normals_[3 * v + k];
        }
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(moving_.size() * sizeof(float)),
                 moving_.data(), GL_STREAM_DRAW);
}

}  // namespace risorius::render
