// SPDX-License-Identifier: MIT
/// \file
/// Draws the hair of a style (locks.h): opaque, with a texture of strands, lit at its vertices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/locks.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/shader_constants.h"

namespace risorius::render {

class LockLayer {
  public:
    /// `constants`: those of Lights. `layer`: it is drawn into a skin layer (skin_layer.h) and looked up there. The context must
    /// be current.
    LockLayer(const Scene& scene, Hair hair, const Camera& camera, const ShaderConstants& constants,
              bool layer);
    ~LockLayer();
    LockLayer(const LockLayer&) = delete;
    LockLayer& operator=(const LockLayer&) = delete;

    bool empty() const { return hair_.empty(); }
    /// Skin that the hair always hides, see Hair.
    const std::vector<std::uint8_t>& covered() const { return hair_.covered; }
    /// Moves the hair with the skin, and leaves out the locks that face away from the camera.
    void upload(const Pose& pose);
    /// Draws fewer and simpler locks with the current program, whose first attribute is the position.
    void draw_casters() const;
    /// Draws into the bound framebuffer with depth; binds a vertex array of its own.
    void draw() const;
    /// Records the cells that the hair covers in this clip space.
    void touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells);
    /// Draws with the current program what was touched and needs samples; binds a vertex array of its own.
    void look_up(const PictureCells& cells);

  private:
    void choose(const PosedHair& posed);

    Hair hair_;
    Points rest_;
    Vec3 camera_;
    GlProgram program_, thin_program_;
    std::vector<float> vertices_;
    std::vector<unsigned> chosen_;  ///< triangles; first those with single hairs
    std::size_t thin_ = 0;          ///< indices of these
    std::vector<unsigned> whole_;   ///< the others, while they are chosen
    std::vector<ClipBox> boxes_;    ///< of the chosen triangles
    GLuint array_ = 0, buffer_ = 0, elements_ = 0, casters_ = 0, sampled_ = 0, strands_ = 0;
};

}  // namespace risorius::render
