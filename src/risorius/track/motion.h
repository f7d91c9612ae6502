// SPDX-License-Identifier: MIT
/// \file
/// How a face moves from one drive to the next.
#pragma once

namespace risorius::track {

/// kDynamic: with inertia, damping and activation dynamics. kQuasiStatic: every frame is an equilibrium under its drive, and
/// excitation is used as activation.
enum class Motion { kDynamic, kQuasiStatic };

}  // namespace risorius::track
