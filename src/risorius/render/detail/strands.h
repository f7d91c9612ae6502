// SPDX-License-Identifier: MIT
/// \file
/// Single hairs that grow from the skin and move with it: brows and lashes, planned from landmarks and the ends of the lids, for any head.
#pragma once

#include <array>
#include <vector>

#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/scene.h"

namespace risorius::render {

constexpr std::size_t kStrandPoints = 5;

/// A point of a skin triangle.
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
    int eye = -1;                            ///< of a lash: 0 left, 1 right; of a brow: none
    std::array<Vec3, kStrandPoints> offset;  ///< from the root, m, in the frame of the root
    double width_m = 0;                      ///< at the root
    double shade = 1;                        ///< times the tone of hair
};

/// Axes of a brow's root: along its triangle's first edge, across, and outwards.
Mat3 skin_frame(const SkinPlace& place, const Points& positions);

/// Axes of a lash's root: from the inner to the outer corner, up, and away from the middle of the eye. With the lid, the lash
/// turns about the eye.
Mat3 lid_frame(int eye, const Vec3& root, const Vec3& eye_centre, const Vec3& inner,
               const Vec3& outer);

/// Hairs of both brows; none where the plan has no brow. `skin` are the painted triangles.
std::vector<Strand> plan_brows(const Scene& scene, const SkinPlan& plan, const Vec3& paint_centre,
                               const std::vector<unsigned>& skin);

/// Lashes of one eye along the ends of its lids as they are seen from the front; none when the eye is shut or not marked.
std::vector<Strand> plan_lashes(const Scene& scene, int eye);

/// Where the lower lid meets the eye, from the inner to the outer corner; none when the eye is shut or not marked.
std::vector<SkinPlace> plan_tear_line(const Scene& scene, int eye);

}  // namespace risorius::render
