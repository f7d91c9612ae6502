// SPDX-License-Identifier: MIT
/// \file
/// Draws the tear film along the lower lids: a concave meniscus between lid and eye that reflects the lamps.
#pragma once

#include <array>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/strands.h"
#include "risorius/render/detail/streamed_triangles.h"

namespace risorius::render {

class TearLayer {
  public:
    /// Nothing is drawn when no lids are found. `constants`: those of Lights. The context must be current.
    TearLayer(const Scene& scene, const ShaderConstants& constants);

    void upload(const Pose& pose, const PosedMarks& marks);
    /// Adds the reflected light to the picture; binds a vertex array of its own.
    void draw() const;
    void mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const {
        triangles_.mark(clip_from_world, cells);
    }

  private:
    std::array<std::vector<SkinPlace>, 2> lines_;  ///< left eye, right eye
    std::array<Eye, 2> eyes_;
    double
        share_;  ///< of the light that the line mirrors; less where faces have a complexion of their own
    GlProgram program_;
    StreamedTriangles triangles_;
};

}  // namespace risorius::render
