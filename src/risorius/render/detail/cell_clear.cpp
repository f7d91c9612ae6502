// SPDX-License-Identifier: MIT
#include "risorius/render/detail/cell_clear.h"

#include <algorithm>

#include "risorius/render/detail/shaders.h"

namespace risorius::render {

CellClear::CellClear() : program_("clear", clear_vertex_shader(), clear_shader()) {
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(1, &buffer_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 2 * sizeof(float), nullptr);
    glBindVertexArray(static_cast<GLuint>(outer));
}

CellClear::~CellClear() {
    glDeleteBuffers(1, &buffer_);
    glDeleteVertexArrays(1, &array_);
}

void CellClear::clear(const PictureCells& cells, int width_px, int height_px) {
    using Kind = PictureCells::Kind;
    corners_.clear();
    const auto x_of = [&](int column) {
        const int x = std::min(column * PictureCells::kSide_px, width_px);
        return 2.0F * static_cast<float>(x) / static_cast<float>(width_px) - 1.0F;
    };
    const auto y_of = [&](int row) {
        const int y = std::min(row * PictureCells::kSide_px, height_px);
        return 2.0F * static_cast<float>(y) / static_cast<float>(height_px) - 1.0F;
    };
    for (int row = 0; row < cells.rows(); ++row)
        for (int column = 0; column < cells.columns(); ++column) {
            if (cells.at(column, row) != Kind::kSampled) continue;
            const int first = column;
            while (column + 1 < cells.columns() && cells.at(column + 1, row) == Kind::kSampled)
                ++column;
            const float left = x_of(first), right = x_of(column + 1), low = y_of(row),
                        high = y_of(row + 1);
            corners_.insert(corners_.end(), {left, low, right, low, right, high, left, low, right,
                                             high, left, high});
        }
    if (corners_.empty()) return;
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(float)),
                 corners_.data(), GL_STREAM_DRAW);
    program_.use();
    glDepthFunc(GL_ALWAYS);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size() / 2));
    glDepthFunc(GL_LESS);
}

}  // namespace risorius::render
