// SPDX-License-Identifier: MIT
/// \file
/// Clears only those cells of a picture that are drawn in samples (picture_cells.h), because clearing all memory would take as
/// long as drawing.
#pragma once

#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"

namespace risorius::render {

class CellClear {
  public:
    /// The context must be current.
    CellClear();
    ~CellClear();
    CellClear(const CellClear&) = delete;
    CellClear& operator=(const CellClear&) = delete;

    /// Sets colour and alpha to 0 and depth to the farthest value in a viewport of the given size. Binds a vertex array of its
    /// own.
    void clear(const PictureCells& cells, int width_px, int height_px);

  private:
    GlProgram program_;
    std::vector<float> corners_;
    GLuint array_ = 0, buffer_ = 0;
};

}  // namespace risorius::render
