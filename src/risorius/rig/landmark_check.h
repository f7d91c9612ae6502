// SPDX-License-Identifier: MIT
/// \file
/// Finds landmarks that do not fit the others. Each landmark is predicted by a warp of the atlas that fits the others, and by the
/// mirror image of its partner. It is suspect when its distance from the prediction exceeds the variation between faces.
///
///   e   distance of a landmark from its prediction, m
///   d   uncertainty of the warp at that point, m: about the distance of the nearest other landmarks
///   s   variance of faces about the atlas per d: e^2 / d, m
///
/// The predictions without each landmark need only one matrix inverse: Dubrule 1983, Math. Geol. 15(6), 687-699.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// A landmark, and its prediction from the others.
struct LandmarkPrediction {
    std::string id;
    Vec3 expected;     ///< head frame, m
    Vec3 found;        ///< head frame, m
    double off_m = 0;  ///< e
    double ratio = 0;  ///< e over the usual distance at that point, sqrt(s d) or less; typically 1
    /// The same ratio for the prediction by the mirror image of the partner
    double mirror_ratio = 0;
};

/// Predicts every landmark from all others. `in_head`: at least four landmarks, all of them in the atlas.
std::vector<LandmarkPrediction> predict_each(const std::map<std::string, Vec3>& in_head,
                                             const Atlas& atlas, double size);

/// Limits above which a landmark is suspect; both must be exceeded.
struct LandmarkLimits {
    double ratio = 3.2;   ///< e over the usual distance
    double off_m = 7e-3;  ///< e, m at atlas size
};

/// Removes the worst landmark and predicts the others again, until none is suspect. Thus a wrong landmark does not make its
/// neighbours suspect. Returns the removed landmarks, worst first.
std::vector<LandmarkPrediction> doubtful_landmarks(std::map<std::string, Vec3> in_head,
                                                   const Atlas& atlas, double size,
                                                   const LandmarkLimits& limits = {});

/// Ids of left landmarks "_l" that lie to the subject's right of their partner "_r". The midplane is the one that fits most
/// pairs.
std::vector<std::string> exchanged_pairs(const std::map<std::string, Vec3>& landmarks,
                                         const Atlas& atlas);

}  // namespace risorius::rig
