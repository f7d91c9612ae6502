// SPDX-License-Identifier: MIT
/// \file
/// Chooses the triangles of a scene to be drawn in a pose: those that the camera sees, and those whose shadows it may see.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/scene_triangles.h"
#include "risorius/render/detail/skin_layer.h"

namespace risorius::render {

class TriangleChoice {
  public:
    /// `positions`: x, y, z of each vertex now, m; `wrinkled`: per vertex now, or empty when nothing folds. All are looked at when
    /// something is chosen, and have to outlive it.
    TriangleChoice(const SceneTriangles& triangles, const std::vector<float>& positions,
                   const std::vector<std::uint8_t>& wrinkled)
        : triangles_(triangles), positions_(positions), wrinkled_(wrinkled) {}

    /// Call when positions have changed.
    void moved() { looked_from_.reset(); }
    /// Which triangles of each batch the next draws are of: those within the clip space that do not turn their back to it, of
    /// batches that have one; of where things are now. Skin with wrinkles on it apart from the rest. As coarse as may be unless
    /// `whole`.
    void choose(const Eigen::Matrix4f& clip_from_world, bool whole);
    /// Which throw shadows: those of the skin, whichever side is lit (light that has come in at the mouth does not go out at the
    /// back of the head), that lie nearer to the lamp than something that is seen there. Without a clip space all is taken to be seen.
    void choose_casters(const Eigen::Matrix4f& light_from_world,
                        const Eigen::Matrix4f* clip_from_world);
    /// Of what was chosen to be seen leaves out: eyes, teeth, gums and tongue where they lie behind the skin of the layer; and
    /// skin where the layer is the picture already, which the cells know afterwards. What lines the mouth stays: a gap narrower
    /// than the layer's pixels shows it.
    void leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                          const std::function<void(PictureCells&)>& mark_others);

    /// Vertices of what was chosen last, three for each triangle.
    const std::vector<unsigned>& corners() const { return choice_; }
    /// In those of a purpose: first smooth triangles, then wrinkled ones, in indices.
    struct Range {
        int first = 0, smooth = 0, wrinkled = 0;
    };
    const Range& range(const Batch& batch, Purpose purpose) const {
        return ranges_[static_cast<std::size_t>(purpose)]
                      [static_cast<std::size_t>(&batch - triangles_.batches().data())];
    }

  private:
    std::vector<Range>& ranges(Purpose purpose) {
        return ranges_[static_cast<std::size_t>(purpose)];
    }
    Eigen::Vector4f place_in(const Eigen::Matrix4f& clip_from_world, std::size_t vertex) const;
    void look_from(const Eigen::Matrix4f& clip_from_world);
    bool is_seen(const unsigned* face, bool cull_back) const;
    /// Where a triangle lies in the clip space last chosen by, and its nearest depth, 0..1.
    ClipBox box_of(const unsigned* face) const;
    float nearest_depth(const unsigned* face) const;
    /// Keeps of the choice to be seen the triangles of batches that keep(batch, triangle).
    template <typename Keep>
    void keep_if(Keep keep);

    const SceneTriangles& triangles_;
    const std::vector<float>& positions_;
    const std::vector<std::uint8_t>& wrinkled_;
    std::array<std::vector<Range>, kPurposes> ranges_;
    std::vector<unsigned> choice_, wrinkled_choice_;
    std::optional<Eigen::Matrix4f> looked_from_;
    std::vector<float> clip_places_;  ///< x, y, z over w, and w; as looked from there
    std::vector<float> lit_places_, farthest_lit_;
};

}  // namespace risorius::render
