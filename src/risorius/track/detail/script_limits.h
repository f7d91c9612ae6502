// SPDX-License-Identifier: MIT
/// \file
/// Limits of a script that its header and its events share.
#pragma once

namespace risorius::track {

inline constexpr double kLongest_s = 3600;  ///< of a script, an event and a time in it

}  // namespace risorius::track
