// SPDX-License-Identifier: MIT
#include "risorius/render/detail/streamed_triangles.h"

namespace risorius::render {

StreamedTriangles::StreamedTriangles(const std::vector<unsigned>& indices,
                                     std::initializer_list<int> sizes)
    : indices_(indices) {
    for (const int size : sizes) floats_ += static_cast<std::size_t>(size);
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(1, &buffer_);
    glGenBuffers(1, &elements_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices_.size() * sizeof(unsigned)), indices_.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    GLuint location = 0;
    std::size_t offset = 0;
    for (const int size : sizes) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE,
                              static_cast<GLsizei>(floats_ * sizeof(float)),
                              reinterpret_cast<const void*>(offset * sizeof(float)));
        ++location;
        offset += static_cast<std::size_t>(size);
    }
    glBindVertexArray(static_cast<GLuint>(outer));
}

StreamedTriangles::~StreamedTriangles() {
    const GLuint buffers[] = {buffer_, elements_};
    glDeleteBuffers(2, buffers);
    glDeleteVertexArrays(1, &array_);
}

std::vector<float> StreamedTriangles::take() {
    vertices_.clear();
    return std::move(vertices_);
}

void StreamedTriangles::upload(std::vector<float> vertices) {
    vertices_ = std::move(vertices);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(float)),
                 vertices_.data(), GL_STREAM_DRAW);
}

void StreamedTriangles::draw() const {
    if (indices_.empty()) return;
    glBindVertexArray(array_);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void StreamedTriangles::mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const {
    for (std::size_t i = 0; i + 2 < indices_.size(); i += 3) {
        ClipBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* p = vertices_.data() + floats_ * indices_[i + k];
            const Eigen::Vector4f clip = clip_from_world * Eigen::Vector4f(p[0], p[1], p[2], 1.0F);
            box.add(clip.x() / clip.w(), clip.y() / clip.w(), clip.w());
        }
        cells.mark(box);
    }
}

}  // namespace risorius::render
