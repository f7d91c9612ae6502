// SPDX-License-Identifier: MIT
/// \file
/// The outermost skin in every direction from a point inside the head, on the six faces of a cube.
#pragma once

#include <optional>
#include <vector>

#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/detail/strands.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class HeadRadius {
  public:
    /// `centre`: the point inside, m. Ears are those of `plan`.
    HeadRadius(const Scene& scene, const SkinPlan& plan, const Vec3& centre);

    /// Returns the outermost skin in a direction, or nothing where the mesh is open, as below the neck.
    std::optional<SkinPlace> skin_at(const Vec3& direction) const;
    /// Returns whether the outermost skin in a direction is an ear's.
    bool is_ear(const Vec3& direction) const;
    /// Returns the distance from the centre to the skin, m, between the cells of the cube; 0 where the mesh is open. `ears`:
    /// whether they count.
    double radius_m(const Vec3& direction, bool ears) const;
    const Vec3& centre() const { return centre_; }

  private:
    static constexpr int kSide = 96;  ///< cells along each side of a face: 1 to 2 mm on the scalp
    struct Cell {
        double radius_m = 0, without_ears_m = 0;
        bool ear = false;
        SkinPlace place;
    };
    void fill(int face, const std::array<Vec3, 3>& corner, const SkinPlace& triangle, bool ear);
    std::size_t index(int face, int x, int y) const;
    const Cell& cell(const Vec3& direction) const;

    Vec3 centre_;
    std::vector<Cell> cells_;
};

}  // namespace risorius::render
