// SPDX-License-Identifier: MIT
/// \file
/// Draws a bowl around each eyeball, open to the front. It closes the gap between an eye and lids that do not touch it, so that
/// one cannot see through the head.
#pragma once

#include <array>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/streamed_triangles.h"

namespace risorius::render {

class SocketLayer {
  public:
    /// Nothing is drawn for eyes that are missing or have no lid landmarks. `constants`: those of Lights. The context must be
    /// current.
    SocketLayer(const Scene& scene, const PosedMarks& marks, const ShaderConstants& constants);

    void upload(const Pose& pose, const PosedMarks& marks);
    /// Draws opaque with depth test; binds a vertex array of its own.
    void draw() const;
    void mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const {
        triangles_.mark(clip_from_world, cells);
    }

  private:
    SocketLayer(const Scene& scene, const std::array<int, 2>& vertex,
                const ShaderConstants& constants);

    std::array<int, 2> vertex_;  ///< a vertex on the surface of each eyeball, or -1 for no bowl
    std::array<Vec3, 2> rest_;   ///< rest position of that vertex, m
    std::array<Eye, 2> eyes_;
    GlProgram program_;
    StreamedTriangles triangles_;
};

}  // namespace risorius::render
