// SPDX-License-Identifier: MIT
/// \file
/// Tetrahedra about a common edge, three by three: six nodes where they would have twelve one by one.
///
/// A fan has nodes a, b (the edge), then r_0 .. r_k around it; its tets are (a, b, r_i, r_i+1). The three of a cut prism are one.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

inline constexpr int kFanTets = 3;

struct TetFan {
    std::array<int, kFanTets> tets;
    std::array<int, kFanTets + 3> nodes;  ///< a, b, r_0 .. r_3
};

struct TetFans {
    std::vector<TetFan> fans;
    std::vector<int> alone;  ///< tets that are in none, ascending
};

/// As many fans as are found by taking those first whose tets have the nearest numbers.
TetFans find_fans(const Tets& tets);

}  // namespace risorius::tissue
