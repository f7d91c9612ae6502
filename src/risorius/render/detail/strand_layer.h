// SPDX-License-Identifier: MIT
/// \file
/// Draws the hairs of a scene as ribbons that face the camera.
#pragma once

#include <vector>

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/strands.h"
#include "risorius/render/detail/streamed_triangles.h"

namespace risorius::render {

class StrandLayer {
  public:
    /// `sample_m`: size of a sample at the head; thinner hairs are drawn wider and paler. `constants`: those of Lights. The
    /// context must be current.
    StrandLayer(const Scene& scene, std::vector<Strand> strands, const Camera& camera,
                double sample_m, ShaderConstants constants);
    void upload(const Pose& pose, const PosedMarks& marks);
    /// Blends the hairs over the picture; binds a vertex array of its own.
    void draw() const;
    void mark(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) const {
        triangles_.mark(clip_from_world, cells);
    }

  private:
    std::vector<Strand> strands_;
    std::array<Eye, 2> eyes_;
    /// Rest position of a vertex of each eyeball, m; the turn of the eye follows from it
    std::array<Vec3, 2> eye_point_;
    std::array<int, 2> eye_vertex_{-1, -1};  ///< the number of that vertex
    Vec3 camera_;
    double sample_m_;
    GlProgram program_;
    StreamedTriangles triangles_;
};

}  // namespace risorius::render
