// A face at a moment, as it is shown.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"

namespace risorius::face {

/// Where everything is, in the head frame; the head's own turn is already applied to the vertices.
struct FacePose {
    Points vertices;                   ///< V x 3, m, the mesh's own order
    std::array<Mat3, 2> eye_rotation;  ///< world from rest, left and right
    Points fold_depth;  ///< V x 3 or no rows, m: of wrinkles finer than the mesh, see skin_layer.h
    Rigid head = Rigid::Identity();
    double jaw_open = 0;                 ///< opening / that of the channel jaw_open at 1
    Rigid mandible = Rigid::Identity();  ///< from rest, before the head's turn
    JawPlace jaw;
    double tooth_force_n = 0;  ///< what all teeth press with; known when muscles move the jaw
};

}  // namespace risorius::face
