// SPDX-License-Identifier: MIT
/// \file
/// Triangles of a scene by material, each ordered front to back; for skin and eyes also simplified ones for small pictures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "risorius/render/detail/coarser_faces.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Triangles of one material (and one eye): a range of the element buffer.
struct Batch {
    Material material;
    int eye;
    int texture;  ///< of the scene, or -1; the skin has its own in its paint
    int first_index;
    int index_count;
    bool cull_back;  ///< counter-clockwise from outside, so what turns away is hidden
};

/// What a choice of triangles is for.
enum class Purpose { kSeen, kShadow };
constexpr std::size_t kPurposes = 2;

class SceneTriangles {
  public:
    /// The triangles must name vertices that there are.
    SceneTriangles(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                   const Coarseness& coarseness);

    const std::vector<Batch>& batches() const { return batches_; }
    /// Vertices of the scene, three for each triangle.
    const std::vector<unsigned>& indices() const { return indices_; }
    int skin_index_count() const;
    /// Corners of a batch's triangles, three each: fewer ones where it has them for the purpose, unless `whole`.
    std::span<const unsigned> corners_of(const Batch& batch, Purpose purpose, bool whole) const;
    /// The fewer ones of the skin; none: as it is.
    const std::vector<unsigned>& coarse_skin(Purpose purpose) const {
        return coarse_skin_[static_cast<std::size_t>(purpose)];
    }

  private:
    void add_batch(const Scene& scene, Material material, int eye, int texture, const Vec3& camera,
                   const Vec3& paint_centre, const Coarseness& coarseness);

    std::vector<Batch> batches_;
    std::vector<unsigned> indices_;
    std::array<std::vector<unsigned>, kPurposes> coarse_skin_;
    std::vector<std::vector<unsigned>> coarse_eyes_;  ///< of each batch; none: as it is
};

}  // namespace risorius::render
