// SPDX-License-Identifier: MIT
/// \file
/// The shader program of each material and its constants of the head.
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
    /// How the skin is shaded.
    enum class Skin {
        kPlain,
        kVeil,
        kLayer
    };  ///< by itself, over `muscles`, for others to look up
    /// `draft`: skin that is not a veil is lit at its vertices. `shaded_m`: between places where skin is shaded. `constants` of Lights.
    Materials(const Scene& scene, const SceneBuffers& buffers, Skin skin, bool draft,
              double shaded_m, const ShaderConstants& constants, const MuscleLayer* muscles);

    /// Makes the batch's program current, with blending for the cornea.
    void use(const Batch& batch, const Pose& pose, const PosedMarks& marks) const;
    void done() const;
    /// Tells another program the colours of a material, and of an eye at rest its measures.
    void tell_colours(const GlProgram& program, Material material, int eye) const;
    /// Draws the skin, with folds where it has some.
    void draw_skin(const Batch& batch, const SceneBuffers& buffers) const;

  private:
    /// Each has a program of its own.
    struct Kind {
        Material material;
        bool own;  ///< of own, not generated colours
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
    std::unique_ptr<GlProgram> folded_skin_;     ///< when the scene has folds
    mutable std::unique_ptr<GlProgram> values_;  ///< made when values are first shown
    std::array<Eye, 2> eyes_;
    std::array<bool, 2> separate_cornea_{false, false};
    std::array<double, 2> iris_depth_m_{0, 0};
    Appearance appearance_;
    bool draft_, pores_;
};

}  // namespace risorius::render
