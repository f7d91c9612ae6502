// SPDX-License-Identifier: MIT
/// \file
/// How a face goes from one drive to the next.
#pragma once

namespace risorius::track {

/// kDynamic: with inertia, damping and time for muscles to act. kQuasiStatic: every frame is in equilibrium with its drive, and
/// excitation is taken as activation.
enum class Motion { kDynamic, kQuasiStatic };

}  // namespace risorius::track
