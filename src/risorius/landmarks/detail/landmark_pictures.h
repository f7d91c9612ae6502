// SPDX-License-Identifier: MIT
/// \file
/// Pictures of a head with its proposed landmarks: green where they are sure, amber and red where they have to be checked.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/landmarks/detail/certainty.h"
#include "risorius/landmarks/propose_landmarks.h"

namespace risorius::landmarks {

/// sRGB 0..1; blue in place of green would be no better for the colour-blind, so sure landmarks are also smaller.
Vec3 certainty_colour(Certainty certainty);

/// From the front, from both sides, and from half left. `at`: positions in the frame of `head`.
std::vector<LandmarkPicture> landmark_pictures(
    const ShownHead& head, const std::map<std::string, JudgedLandmark>& at,
    const std::map<std::string, ProposedLandmark>& proposed);

}  // namespace risorius::landmarks
