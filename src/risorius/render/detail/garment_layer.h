// SPDX-License-Identifier: MIT
/// \file
/// Draws the garment (garment.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/garment.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/shader_constants.h"

namespace risorius::render {

class GarmentLayer {
  public:
    /// `constants`: those of Lights. `layer`: it is drawn into a skin layer (skin_layer.h) and looked up there. The context must
    /// be current.
    GarmentLayer(const Scene& scene, Garment garment, const Camera& camera,
                 const ShaderConstants& constants, bool layer);
    ~GarmentLayer();
    GarmentLayer(const GarmentLayer&) = delete;
    GarmentLayer& operator=(const GarmentLayer&) = delete;

    bool empty() const { return garment_.empty(); }
    const std::vector<std::uint8_t>& covered() const { return garment_.covered; }
    void upload(const Points& positions);
    /// Draws into the bound framebuffer with depth; binds a vertex array of its own.
    void draw() const;
    /// Records the cells that the cloth covers in this clip space.
    void touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells);
    /// Draws with the current program what was touched and needs samples; binds a vertex array of its own.
    void look_up(const PictureCells& cells);

  private:
    Garment garment_;
    Vec3 camera_;
    std::unique_ptr<GlProgram> program_;  ///< null when there is nothing to draw
    std::vector<float> vertices_;
    std::vector<ClipBox> boxes_;  ///< of the triangles
    GLuint array_ = 0, buffer_ = 0, elements_ = 0, sampled_ = 0;
};

}  // namespace risorius::render
