// SPDX-License-Identifier: MIT
/// \file
/// The 52 blend shapes of ARKit face tracking, by name, in the order of face captures.
/// Source: Apple, ARFaceAnchor.BlendShapeLocation; the order is that of the tables of Live Link Face.
#pragma once

#include <string>
#include <vector>

namespace risorius::track {

/// Returns the names "eyeBlinkLeft" and so on, in the order of the source.
const std::vector<std::string>& arkit_names();

}  // namespace risorius::track
