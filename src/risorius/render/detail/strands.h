// SPDX-License-Identifier: MIT
/// \file
/// Single hairs that grow from the skin and move with it: brows and lashes. They are planned for any head from its landmarks and
/// the margins of its lids.
#pragma once

#include <array>
#include <vector>

#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

constexpr std::size_t kStrandPoints = 5;

/// A point on a triangle of the skin.
struct SkinPlace {
    std::array<int, 3> corner{};
    Vec3 fraction = Vec3::Zero();  ///< barycentric

    Vec3 on(const Points& positions) const {
        return (fraction[0] * positions.row(corner[0]) + fraction[1] * positions.row(corner[1]) +
                fraction[2] * positions.row(corner[2]))
            .transpose();
    }
};

struct Strand {
    SkinPlace root;
    int eye = -1;                            ///< for a lash: 0 left, 1 right; for a brow hair: -1
    std::array<Vec3, kStrandPoints> offset;  ///< from the root, m, in the frame of the root
    double width_m = 0;                      ///< at the root
    double shade = 1;                        ///< factor of the hair tone
};

/// Returns the axes at the root of a brow hair as columns: along the first edge of its triangle, across that in the skin, and
/// outwards.
Mat3 skin_frame(const SkinPlace& place, const Points& positions);

/// Returns the axes at the root of a lash as columns: from the inner to the outer corner of the eye, up, and away from the centre
/// of the eye. All arguments are positions in the same pose, m. As the lid moves, the lash turns about the eye.
Mat3 lid_frame(int eye, const Vec3& root, const Vec3& eye_centre, const Vec3& inner,
               const Vec3& outer);

/// Returns the hairs of both brows; none where the plan has no brow. `skin`: the painted triangles.
std::vector<Strand> plan_brows(const Scene& scene, const SkinPlan& plan, const Vec3& paint_centre,
                               const std::vector<unsigned>& skin);

/// Returns the lashes of one eye along its lid margins as seen from the front; none when the eye is closed or has no landmarks.
std::vector<Strand> plan_lashes(const Scene& scene, int eye);

/// Returns the line where the lower lid meets the eye, from the inner to the outer corner; empty when the eye is closed or has no
/// landmarks.
std::vector<SkinPlace> plan_tear_line(const Scene& scene, int eye);

}  // namespace risorius::render
