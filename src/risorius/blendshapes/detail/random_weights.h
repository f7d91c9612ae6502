// SPDX-License-Identifier: MIT
/// \file
/// Random weights of shapes for tests of a blend shape rig. They depend only on the names of the shapes and the seed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

/// Returns one vector of weights per frame. In each frame, four random shapes have random weights; the frames are independent.
std::vector<Eigen::VectorXd> random_weights(const MadeShapes& shapes, int frames, unsigned seed);

/// Returns a random track, one vector of weights per frame, with one frame per second. In it, action units of the upper and lower
/// face of FACS, the Facial Action Coding System, come and go (AU1 to AU28, AU38, AU39, AU43; no action descriptors). On average,
/// 2.5 units are active, at intensities from trace to maximum, more often on both sides than on one, with onsets of 0.25 to 0.6 s
/// and offsets of 0.3 to 0.8 s. Units that are degrees or opposites of each other, such as AU25, AU26 and AU27, do not occur
/// together. Empty for shapes that are not action units.
std::vector<Eigen::VectorXd> random_facs_track(const MadeShapes& shapes, int frames, unsigned seed);

}  // namespace risorius::blendshapes
