// SPDX-License-Identifier: MIT
/// \file
/// What is shown of tissue whose steps, of a few iterations, leave surfaces in each other: the same nodes moved out of lips,
/// bone, teeth and eyeballs.
///
/// Forces have no part in it and nothing of it goes back into the state: fed back it would make held poses tremble. A pose that
/// has come to rest is hardly changed, one without contact not at all.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/solver/detail/contact_search.h"

namespace risorius::face {

/// Nodes of x, n x 3 m, out of each other and out of the bones but for a quarter of a millimetre or less, if a few sweeps get
/// there. `fixed`: rows of x that stay.
Points resolve_penetration(const Points& x, const ContactSearch& search, const Rigid& mandible,
                           const std::array<Mat3, 2>& gaze, const std::vector<char>& fixed);

}  // namespace risorius::face
