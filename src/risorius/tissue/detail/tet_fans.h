// SPDX-License-Identifier: MIT
/// \file
/// Groups tetrahedra around a common edge in fans of three. A fan has six nodes; three separate tets have twelve.
///
/// A fan has nodes a, b (the edge) and r_0 .. r_3 around it. Its tets are (a, b, r_i, r_i+1). The three tets into which a prism
/// is cut form a fan.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

inline constexpr int kFanTets = 3;

/// Three tets around a common edge.
struct TetFan {
    std::array<int, kFanTets> tets;
    std::array<int, kFanTets + 3> nodes;  ///< a, b, r_0 .. r_3
};

/// All tets of a mesh, in fans or alone.
struct TetFans {
    std::vector<TetFan> fans;
    std::vector<int> alone;  ///< tets that are in no fan, ascending
};

/// Finds fans one after the other; the fan whose tets have the closest indices is taken first.
TetFans find_fans(const Tets& tets);

}  // namespace risorius::tissue
