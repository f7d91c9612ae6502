// SPDX-License-Identifier: MIT
/// \file
/// Selects the triangles of a scene to draw in a pose: those that the camera sees, and those that cast visible shadows.
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
    /// `positions`: current x, y, z of each vertex, m. `wrinkled`: current flag per vertex, or empty when nothing folds. Both are
    /// read at every selection and must outlive this object.
    TriangleChoice(const SceneTriangles& triangles, const std::vector<float>& positions,
                   const std::vector<std::uint8_t>& wrinkled)
        : triangles_(triangles), positions_(positions), wrinkled_(wrinkled) {}

    /// Leaves out the triangles all of whose vertices are marked, unless simplified triangles are not wanted. One mark per vertex
    /// of the scene, or none.
    void hide(const std::vector<std::uint8_t>& vertices) { hidden_ = vertices; }
    /// Call when positions have changed.
    void moved() { looked_from_.reset(); }
    /// Selects the triangles to draw next, for the current positions: those inside the clip space, and only those that face the
    /// camera in batches with cull_back. Wrinkled skin is listed separately. Simplified triangles are used unless `whole` is
    /// true.
    void choose(const Eigen::Matrix4f& clip_from_world, bool whole);
    /// Selects the triangles that cast visible shadows: triangles of the skin that are nearer to the lamp than something visible.
    /// They may face the lamp or not, so that light that enters the mouth does not leave through the back of the head. If
    /// `clip_from_world` is null, everything counts as visible.
    void choose_casters(const Eigen::Matrix4f& light_from_world,
                        const Eigen::Matrix4f* clip_from_world);
    /// Removes triangles from the visible selection that need not be drawn in samples: eyes, teeth, gums and tongue behind the
    /// skin of the layer, and skin in cells that are copied from the layer. The kinds of the cells are recorded in `cells`;
    /// `mark_others` must mark what else is drawn. The lining of the mouth stays, because it may show through gaps narrower than
    /// the places of the layer.
    void leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                          const std::function<void(PictureCells&)>& mark_others);

    /// Vertices of the last selection, three per triangle.
    const std::vector<unsigned>& corners() const { return choice_; }
    /// Range of a batch in the selection of a purpose, counted in indices: first the smooth triangles, then the wrinkled ones.
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
    /// Bounding box of a triangle in the clip space of the last selection, and its smallest depth, 0..1.
    ClipBox box_of(const unsigned* face) const;
    float nearest_depth(const unsigned* face) const;
    /// Keeps only visible triangles for which keep(batch, triangle) is true.
    template <typename Keep>
    void keep_if(Keep keep);

    const SceneTriangles& triangles_;
    const std::vector<float>& positions_;
    const std::vector<std::uint8_t>& wrinkled_;
    std::array<std::vector<Range>, kPurposes> ranges_;
    std::vector<unsigned> choice_, wrinkled_choice_;
    std::optional<Eigen::Matrix4f> looked_from_;
    /// Four numbers per vertex in the clip space of looked_from_: x / w, y / w, z / w, and w
    std::vector<float> clip_places_;
    std::vector<float> lit_places_, farthest_lit_;
    std::vector<std::uint8_t> hidden_;
};

}  // namespace risorius::render
