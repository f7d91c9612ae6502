// SPDX-License-Identifier: MIT
/// \file
/// Finds landmarks that do not fit the others. Each landmark is predicted from the others by the warp of the atlas that fits them, and by
/// the mirror image of its partner. It is suspect when it lies farther from the prediction than faces vary.
///
///   e   distance of a landmark from its prediction, m
///   d   uncertainty of the warp at that place, m: about the distance of the nearest other landmarks
///   s   variance of faces about the atlas per d: e^2 / d, m
///
/// Prediction without the landmark itself in one inverse: Dubrule 1983, Math. Geol. 15(6), 687-699.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// One landmark compared with the others.
struct LandmarkPrediction {
    std::string id;
    Vec3 expected;            ///< head frame, m
    Vec3 found;               ///< head frame, m
    double off_m = 0;         ///< e
    double ratio = 0;         ///< e / the usual distance there, sqrt(s d) or less; 1 is usual
    double mirror_ratio = 0;  ///< the same ratio for the mirror image of its partner alone
};

/// Every landmark predicted from all others. `in_head`: landmarks of the atlas only, four or more.
std::vector<LandmarkPrediction> predict_each(const std::map<std::string, Vec3>& in_head,
                                             const Atlas& atlas, double size);

struct LandmarkLimits {
    double ratio = 3.2;   ///< smallest ratio that is suspect
    double off_m = 7e-3;  ///< smallest distance that is suspect, m at atlas size
};

/// Removes the worst landmark and predicts the others again until none is suspect, so that a wrong landmark does not make its
/// neighbours suspect. Worst first.
std::vector<LandmarkPrediction> doubtful_landmarks(std::map<std::string, Vec3> in_head,
                                                   const Atlas& atlas, double size,
                                                   const LandmarkLimits& limits = {});

/// Ids of left landmarks "_l" that lie on the subject's right of their partner "_r". The middle plane is the one that most pairs agree on.
std::vector<std::string> exchanged_pairs(const std::map<std::string, Vec3>& landmarks,
                                         const Atlas& atlas);

}  // namespace risorius::rig
