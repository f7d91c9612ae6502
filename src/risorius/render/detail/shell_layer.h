// SPDX-License-Identifier: MIT
/// \file
/// Hair of some length on scalp and chin: many layers over the skin, with holes wherever no hair passes through them.
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
    /// `skin`: the painted triangles. Draws nothing when the appearance has no length of hair; `constants` of Lights. The context must be current.
    ShellLayer(const Scene& scene, const SceneBuffers& buffers, const SkinPlan& plan,
               const Vec3& paint_centre, const std::vector<unsigned>& skin,
               ShaderConstants constants);
    ~ShellLayer();
    ShellLayer(const ShellLayer&) = delete;
    ShellLayer& operator=(const ShellLayer&) = delete;

    /// With the scene's vertex array bound.
    void draw() const;
    bool empty() const { return !program_; }

  private:
    std::unique_ptr<GlProgram> program_;  ///< none when there is nothing to draw
    GLuint lengths_ = 0, elements_ = 0;
    int index_count_ = 0, shells_ = 0;
};

}  // namespace risorius::render
