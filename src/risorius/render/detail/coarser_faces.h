// SPDX-License-Identifier: MIT
/// \file
/// Simplified surfaces for small pictures, whose samples are wider than the error of the simplification.
#pragma once

#include <functional>
#include <vector>

#include "risorius/render/detail/face_order.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Largest distance between the simplified and the original surface, m; 0: no simplification.
struct Coarseness {
    double seen_m = 0, shadow_m = 0, eyes_m = 0;
    double moved_m = 0;  ///< for skin where much_moved() is true
    /// True: skin that may wrinkle is not simplified, because its wrinkles are drawn.
    bool keeps_folds = true;
};

/// Simplifies `faces` on the same vertices and keeps the rim. The distance to the given surface in the rest pose is about
/// `error_m` at most (quadric error metric, Garland & Heckbert 1997). Faces for which `stays` is true are kept.
std::vector<Face> coarser_faces(const Points& rest, const std::vector<Face>& faces, double error_m,
                                const std::function<bool(const Face&)>& stays);

/// Predicate: whether poses bend, open or roll up the skin of a face, which is so around the eyes and the mouth. True everywhere
/// when the scene has no landmarks of the mouth.
std::function<bool(const Face&)> much_moved(const Scene& scene);
/// Predicate: whether the skin of a face may wrinkle. Always false unless `wanted`.
std::function<bool(const Face&)> may_fold(const Scene& scene, bool wanted);

}  // namespace risorius::render
