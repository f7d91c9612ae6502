// SPDX-License-Identifier: MIT
/// \file
/// Triangles of a scene by material, each sorted from front to back, with simplified versions of skin and eyes for small
/// pictures.
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
    /// Index of a texture of the scene, or -1; also -1 for skin, whose texture is part of the paint map
    int texture;
    int first_index;
    int index_count;
    /// The triangles are counter-clockwise seen from outside, so their back sides need not be drawn
    bool cull_back;
};

/// The purpose of a selection of triangles.
enum class Purpose { kSeen, kShadow };
constexpr std::size_t kPurposes = 2;

class SceneTriangles {
  public:
    /// All vertex indices of the scene's triangles must be in range.
    SceneTriangles(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                   const Coarseness& coarseness);

    const std::vector<Batch>& batches() const { return batches_; }
    /// Vertex indices of the scene, three per triangle.
    const std::vector<unsigned>& indices() const { return indices_; }
    int skin_index_count() const;
    /// Returns the vertex indices of the triangles of a batch, three each. Simplified triangles are returned if there are any for
    /// the purpose and `whole` is false.
    std::span<const unsigned> corners_of(const Batch& batch, Purpose purpose, bool whole) const;
    /// The simplified skin; empty: not simplified.
    const std::vector<unsigned>& coarse_skin(Purpose purpose) const {
        return coarse_skin_[static_cast<std::size_t>(purpose)];
    }

  private:
    void add_batch(const Scene& scene, Material material, int eye, int texture, const Vec3& camera,
                   const Vec3& paint_centre, const Coarseness& coarseness);

    std::vector<Batch> batches_;
    std::vector<unsigned> indices_;
    std::array<std::vector<unsigned>, kPurposes> coarse_skin_;
    std::vector<std::vector<unsigned>> coarse_eyes_;  ///< per batch; empty: not simplified
};

}  // namespace risorius::render
