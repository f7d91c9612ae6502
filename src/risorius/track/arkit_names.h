// SPDX-License-Identifier: MIT
/// \file
/// The 52 blend shapes of ARKit face tracking, by name and in the order in which face captures list them.
/// Source: Apple, ARFaceAnchor.BlendShapeLocation; the order is that of Live Link Face's tables.
#pragma once

#include <string>
#include <vector>

namespace risorius::track {

const std::vector<std::string>& arkit_names();

}  // namespace risorius::track
