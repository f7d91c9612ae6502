// SPDX-License-Identifier: MIT
/// \file
/// Brings a head whose landmarks are known onto another one, and the landmarks with it.
///
/// 1. A similarity of the points that the network sees on both heads (an affine map would misplace the ears).
/// 2. A smooth field of what remains, each point as uncertain as the views differ.
/// 3. The ears: the template's are shifted over a grid, made larger and tilted to where both fit best.
/// 4. Non-rigid registration of the rest: nodes spread over the template's skin are drawn to the nearest skin with a similar
///    normal, point to plane, in three scales (Amberg, Romdhani, Vetter 2007, Optimal step nonrigid ICP, for the idea of scales).
///    In the face they are also drawn along the skin: the mean of the skin around them, weighted by distance and by normal, is
///    compared with the same of their own head (as in coherent point drift: Myronenko, Song 2010).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/landmarks/detail/template_head.h"

namespace risorius::landmarks {

/// A landmark on the new head as one template puts it.
struct PlacedLandmark {
    Vec3 at;  ///< m, on the skin
    double off_m =
        0;  ///< of the template's skin around it from the new one, after the registration
    double unseen_m =
        0;  ///< deviation that what the network sees leaves there, before the registration
};

/// `head` and `face`: the new one, in the frame and size of the template. `lips`: landmarks of the line of its lips, where the network
/// misses it.
std::map<std::string, PlacedLandmark> placed_landmarks(
    const TemplateHead& known, const ShownHead& head, const std::vector<SeenPoint>& face,
    const std::map<std::string, Vec3>& lips = {});

}  // namespace risorius::landmarks
