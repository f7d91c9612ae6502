// SPDX-License-Identifier: MIT
/// \file
/// Random weights of shapes, for tests of a blend shape rig. They depend only on names and seed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

/// Any four shapes at a time; frames are independent.
std::vector<Eigen::VectorXd> random_weights(const MadeShapes& shapes, int frames, unsigned seed);

/// Frames, a second apart, of a track in which the action units of FACS's upper and lower face (AU1 to AU28, AU38, AU39, AU43; not the
/// descriptors of other actions) come and go at random: two and a half at a time, at intensities from trace to maximum, on both sides
/// more often than on one, with onsets of .25 to .6 s and offsets of .3 to .8 s. Degrees of one thing and opposites, such as AU25,
/// AU26 and AU27, do not meet. Empty for shapes that are not action units.
std::vector<Eigen::VectorXd> random_facs_track(const MadeShapes& shapes, int frames, unsigned seed);

}  // namespace risorius::blendshapes
