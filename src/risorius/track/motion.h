// SPDX-License-Identifier: MIT
/// \file
/// The two modes of motion of a simulated face.
#pragma once

namespace risorius::track {

/// kDynamic: the face moves with inertia, damping and activation dynamics. kQuasiStatic: the face is in equilibrium under its
/// drive in every frame, and excitation is used as activation.
enum class Motion { kDynamic, kQuasiStatic };

}  // namespace risorius::track
