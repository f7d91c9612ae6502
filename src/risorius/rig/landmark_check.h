// Landmarks that do not lie where the others say: each is predicted from the others, by the warp of the atlas that fits
// them and by the mirror image of its partner, and doubted when it is farther off than faces vary.
//
//   e   distance of a landmark from its prediction, m
//   d   what the warp's kernel leaves open there, m: about the distance of the nearest other landmarks
//   s   scatter of faces about the atlas, e^2 / d, m
//
// Prediction without the landmark itself in one inverse: Dubrule 1983, Math. Geol. 15(6), 687-699.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/rig/atlas.h"

namespace risorius::rig {

/// One landmark against the others.
struct LandmarkPrediction {
    std::string id;
    Vec3 expected;            ///< head frame, m
    Vec3 found;               ///< head frame, m
    double off_m = 0;         ///< e
    double ratio = 0;         ///< e over what is usual there, sqrt(s d) or less: 1 is usual
    double mirror_ratio = 0;  ///< the same against the mirror image of its partner alone
};

/// Every landmark predicted from all the others. `in_head` holds landmarks of the atlas only, four or more.
std::vector<LandmarkPrediction> predict_each(const std::map<std::string, Vec3>& in_head,
                                             const Atlas& atlas, double size);

struct LandmarkLimits {
    double ratio = 3.2;   ///< how unusual
    double off_m = 7e-3;  ///< how far, at atlas size
};

/// The worst is set aside and the others are asked again, until none is left to doubt: a wrong one does not make its
/// neighbours look wrong. Worst first.
std::vector<LandmarkPrediction> doubtful_landmarks(std::map<std::string, Vec3> in_head,
                                                   const Atlas& atlas, double size,
                                                   const LandmarkLimits& limits = {});

/// Pairs "_l", "_r" whose left one lies on the subject's right, by the middle plane most pairs agree on; ids of the left ones.
std::vector<std::string> exchanged_pairs(const std::map<std::string, Vec3>& landmarks,
                                         const Atlas& atlas);

}  // namespace risorius::rig
