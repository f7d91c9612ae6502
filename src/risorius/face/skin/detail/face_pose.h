// SPDX-License-Identifier: MIT
/// \file
/// The visible state of a face at one moment.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"

namespace risorius::face {

/// A pose. Its vertices are in the world frame, which equals the head frame of the head at rest: they include the motion of the head.
struct FacePose {
    Points vertices;                   ///< V x 3, m, world frame, in the order of the mesh
    std::array<Mat3, 2> eye_rotation;  ///< from rest, in the world frame, left and right
    /// V x 3, m, one column per slot of the wrinkle lines: depth of the wrinkles that are finer than the mesh. No rows without wrinkles.
    Points fold_depth;
    Rigid head = Rigid::Identity();  ///< motion of the head from rest, in the world frame
    double jaw_open = 0;  ///< opening of the jaw / opening when the channel jaw_open is 1
    /// Motion of the mandible from rest, in the head frame.
    Rigid mandible = Rigid::Identity();
    JawPlace jaw;              ///< position of the jaw relative to the skull
    double tooth_force_n = 0;  ///< total bite force of all teeth, N; 0 unless muscles move the jaw
};

}  // namespace risorius::face
