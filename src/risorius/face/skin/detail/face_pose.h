// SPDX-License-Identifier: MIT
/// \file
/// The visible state of a face at one moment.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"

namespace risorius::face {

/// Positions in the head frame; the motion of the head itself is already applied to the vertices.
struct FacePose {
    Points vertices;                   ///< V x 3, m, the mesh's own order
    std::array<Mat3, 2> eye_rotation;  ///< world from rest, left and right
    Points
        fold_depth;  ///< V x 3 or no rows, depth of wrinkles that are finer than the mesh, m, see skin_layer.h
    Rigid head = Rigid::Identity();
    double jaw_open = 0;  ///< opening of the jaw / opening at jaw_open = 1
    Rigid mandible =
        Rigid::Identity();  ///< motion of the mandible from rest, before the motion of the head
    JawPlace jaw;
    double tooth_force_n = 0;  ///< total bite force of all teeth, N; 0 unless muscles move the jaw
};

}  // namespace risorius::face
