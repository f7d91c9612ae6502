// SPDX-License-Identifier: MIT
/// \file
/// Simplified surfaces for pictures whose samples are wider than the error.
#pragma once

#include <functional>
#include <vector>

#include "risorius/render/detail/face_order.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Largest distance of drawn skin and eyes from the scene's, m; 0: no simplification.
struct Coarseness {
    double seen_m = 0, shadow_m = 0, eyes_m = 0;
    double moved_m = 0;  ///< where skin is much_moved()
    bool keeps_folds =
        true;  ///< skin that may wrinkle is not simplified, since its wrinkles are drawn
};

/// Faces of some of the same vertices, about `error_m` from the given ones at most at rest (by quadrics, Garland & Heckbert 1997),
/// with the same rim. Those that `stays` remain as they are.
std::vector<Face> coarser_faces(const Points& rest, const std::vector<Face>& faces, double error_m,
                                const std::function<bool(const Face&)>& stays);

/// Whether poses bend, open or roll up the skin of a face: around eyes and mouth. Everywhere, when the scene does not say where
/// its mouth is.
std::function<bool(const Face&)> much_moved(const Scene& scene);
/// Whether skin may wrinkle, if `wanted`.
std::function<bool(const Face&)> may_fold(const Scene& scene, bool wanted);

}  // namespace risorius::render
