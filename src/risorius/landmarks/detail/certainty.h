// SPDX-License-Identifier: MIT
/// \file
/// Puts together where the templates place a landmark, and judges how far off it may be: by the distance from what the network
/// sees, by how well the template's skin lies on the new one there, by how the templates agree, and by where the other landmarks
/// put it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/landmarks/detail/registration.h"

namespace risorius::landmarks {

struct JudgedLandmark {
    Vec3 at;                ///< m, on the skin
    double expected_m = 0;  ///< how far off it may be
    std::string reason;     ///< what speaks against it; may be empty
};

/// `placed`: by each template, at least one, in the frame of `head`.
std::map<std::string, JudgedLandmark> judged_landmarks(
    const std::vector<std::map<std::string, PlacedLandmark>>& placed, const ShownHead& head,
    const rig::Atlas& atlas);

}  // namespace risorius::landmarks
