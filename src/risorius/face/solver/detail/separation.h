// SPDX-License-Identifier: MIT
/// \file
/// Resolves penetration for display. Steps of few iterations leave penetrations; this moves nodes out of lips, bone, teeth and
/// eyeballs.
///
/// The method is purely geometric. Its result is not fed back into the state, since feedback would make held poses tremble. A pose in
/// equilibrium hardly changes; a pose without contact does not change.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/solver/detail/contact_search.h"

namespace risorius::face {

/// Returns x, n x 3, m, with penetrations reduced to 0.25 mm or less, as far as a few sweeps over the nodes can do it.
/// `fixed` flags the rows of x that do not move. `mandible` is its motion from rest, `gaze` the rotation of each eye.
Points resolve_penetration(const Points& x, const ContactSearch& search, const Rigid& mandible,
                           const std::array<Mat3, 2>& gaze, const std::vector<char>& fixed);

}  // namespace risorius::face
