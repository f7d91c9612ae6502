// SPDX-License-Identifier: MIT
/// \file
/// Finds landmarks that do not fit the others. Each landmark is predicted by a warp of the atlas that fits the others, and by the
/// mirror image of its partner. It is suspect when its distance from the prediction exceeds the variation between faces.
///
///   e   distance of a landmark from its prediction, m
///   d   uncertainty of the warp at that point, m: about the distance of the nearest other landmarks
///   s   variance between faces per d, the mean of e^2 / d over faces, m
///
/// The predictions, each without one landmark, need only one matrix inverse. Source: Dubrule 1983, Math. Geol. 15(6), 687-699.
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
    /// E over the usual distance at that point, which is at most sqrt(s d); typically 1
    double ratio = 0;
    /// The same ratio for the prediction by the mirror image of the partner
    double mirror_ratio = 0;
};

/// Predicts every landmark from all others. `in_head`: positions of at least four landmarks of the atlas, head frame, m. `size`:
/// size of this head over that of the atlas head.
std::vector<LandmarkPrediction> predict_each(const std::map<std::string, Vec3>& in_head,
                                             const Atlas& atlas, double size);

/// Limits above which a landmark is suspect; both must be exceeded.
struct LandmarkLimits {
    double ratio = 3.2;   ///< e over the usual distance
    double off_m = 7e-3;  ///< e, m at atlas size
};

/// Finds the suspect landmarks. The worst one is removed and the others are predicted again, until none is suspect. So a wrong
/// landmark does not make its neighbours suspect. Returns the removed landmarks, the worst one first.
std::vector<LandmarkPrediction> doubtful_landmarks(std::map<std::string, Vec3> in_head,
                                                   const Atlas& atlas, double size,
                                                   const LandmarkLimits& limits = {});

/// Returns the ids of left landmarks "_l" that lie to the subject's right of their partner "_r". The sides are those of the
/// midplane that fits most pairs.
std::vector<std::string> exchanged_pairs(const std::map<std::string, Vec3>& landmarks,
                                         const Atlas& atlas);

}  // namespace risorius::rig
