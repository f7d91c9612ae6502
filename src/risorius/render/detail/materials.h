// SPDX-License-Identifier: MIT
/// \file
/// The shader program of each material, and its constants for this head.
#pragma once

#include <array>
#include <map>
#include <memory>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/muscle_layer.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shader_constants.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class Materials {
  public:
    /// How the skin is shaded: opaque, as a translucent veil over the muscles, or into the skin layer, which is looked up later
    /// (skin_layer.h).
    enum class Skin { kPlain, kVeil, kLayer };
    /// `draft`: skin is lit at its vertices, unless it is a veil. `shaded_m`: distance between the shaded places of the skin.
    /// `constants`: those of Lights.
    Materials(const Scene& scene, const SceneBuffers& buffers, Skin skin, bool draft,
              double shaded_m, const ShaderConstants& constants, const MuscleLayer* muscles);

    /// Makes the batch's program current, with blending for the cornea.
    void use(const Batch& batch, const Pose& pose, const PosedMarks& marks) const;
    void done() const;
    /// Sets the uniforms of `program` for the colours of a material, and for an eye those for its radii at rest.
    void tell_colours(const GlProgram& program, Material material, int eye) const;
    /// Draws the skin, with wrinkles where it has them.
    void draw_skin(const Batch& batch, const SceneBuffers& buffers) const;

  private:
    /// Each kind has its own program.
    struct Kind {
        Material material;
        bool own;  ///< coloured by the mesh's own texture instead of generated colours
        int eye;
        auto operator<=>(const Kind&) const = default;
    };
    static Kind kind_of(const Batch& batch) {
        return {batch.material, batch.texture >= 0, batch.eye};
    }
    ShaderConstants constants_of(const Scene& scene, Material material, int eye,
                                 ShaderConstants constants) const;
    std::unique_ptr<GlProgram> make_program(const Kind& kind, bool folds, Skin skin,
                                            const ShaderConstants& constants,
                                            const MuscleLayer* muscles) const;
    void set_eye(const GlProgram& program, int side, const Pose& pose,
                 const PosedMarks& marks) const;

    std::map<Kind, std::unique_ptr<GlProgram>> programs_;
    std::unique_ptr<GlProgram> folded_skin_;     ///< null when the scene has no folds (scene.h)
    mutable std::unique_ptr<GlProgram> values_;  ///< made when values are shown for the first time
    std::array<Eye, 2> eyes_;
    std::array<bool, 2> separate_cornea_{false, false};
    std::array<double, 2> iris_depth_m_{0, 0};
    Appearance appearance_;
    bool draft_, pores_;
};

}  // namespace risorius::render
