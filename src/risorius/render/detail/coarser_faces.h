// SPDX-License-Identifier: MIT
/// \file
/// Simplified surfaces for small pictures, whose samples are wider than the error of the simplification. A `Face` is a triangle,
/// not the face of the head.
#pragma once

#include <functional>
#include <vector>

#include "risorius/render/detail/face_order.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Largest distances between a simplified surface and the original one, m; 0: no simplification. One for each use: skin that is
/// seen, skin that casts shadows, and eyes.
struct Coarseness {
    double seen_m = 0, shadow_m = 0, eyes_m = 0;
    double moved_m = 0;  ///< the same for visible skin where much_moved() is true
    /// True: skin that may wrinkle is not simplified, because its wrinkles are drawn.
    bool keeps_folds = true;
};

/// Simplifies the triangles `faces` without new vertices and keeps the rim of the surface. The distance to the given surface in
/// the rest pose is about `error_m` at most (quadric error metric, Garland & Heckbert 1997). Triangles for which `stays` is true
/// are kept.
std::vector<Face> coarser_faces(const Points& rest, const std::vector<Face>& faces, double error_m,
                                const std::function<bool(const Face&)>& stays);

/// Returns a predicate that is true for a triangle of skin that poses bend, open or roll up, as they do around the eyes and the
/// mouth. It is true for all triangles when the scene has no landmarks of the mouth.
std::function<bool(const Face&)> much_moved(const Scene& scene);
/// Returns a predicate that is true for a triangle of skin that may wrinkle. It is false for all triangles unless `wanted` is
/// true.
std::function<bool(const Face&)> may_fold(const Scene& scene, bool wanted);

}  // namespace risorius::render
