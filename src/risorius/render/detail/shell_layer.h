// SPDX-License-Identifier: MIT
/// \file
/// Draws long hair on scalp and chin as shells: many copies of the skin at growing heights, transparent wherever no hair passes
/// through them.
///
/// Source: Lengyel et al. 2001, Real-Time Fur over Arbitrary Surfaces.
#pragma once

#include <memory>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class ShellLayer {
  public:
    /// `skin`: the painted triangles. `constants`: those of Lights. Nothing is drawn when the lengths of hair and beard in the
    /// appearance are 0. The context must be current.
    ShellLayer(const Scene& scene, const SceneBuffers& buffers, const SkinPlan& plan,
               const Vec3& paint_centre, const std::vector<unsigned>& skin,
               ShaderConstants constants);
    ~ShellLayer();
    ShellLayer(const ShellLayer&) = delete;
    ShellLayer& operator=(const ShellLayer&) = delete;

    /// Draws the shells; the vertex array of the scene must be bound.
    void draw() const;
    bool empty() const { return !program_; }

  private:
    std::unique_ptr<GlProgram> program_;  ///< null when there is nothing to draw
    GLuint lengths_ = 0, elements_ = 0;
    int index_count_ = 0, shells_ = 0;
};

}  // namespace risorius::render
