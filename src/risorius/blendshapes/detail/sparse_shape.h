// SPDX-License-Identifier: MIT
/// \file
/// A blend shape: displacements of some vertices of a mesh at weight 1. All other vertices do not move.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::blendshapes {

struct SparseShape {
    std::vector<int> vertex;  ///< ascending
    Points delta;             ///< one row per entry of `vertex`, m

    bool empty() const { return vertex.empty(); }
    void add_to(Points& vertices, double weight) const;
    Points dense(long vertices) const;  ///< V x 3
};

/// Returns the rows of `field` (V x 3, m) that are not zero.
SparseShape sparse(const Points& field);

/// Thresholds of fade_out(). Displacements below `none_m` are removed, and those above `all_m` are kept. Between them is a smooth
/// transition, because an abrupt end would show as an edge. Displacements that are then below a fifth of `none_m` are also
/// removed.
struct Fade {
    double none_m = 5e-5, all_m = 1.5e-4;
};
void fade_out(Points& field, const Fade& fade = {});

/// Returns the fraction of the left side (x > 0) at x. It goes smoothly from 0 at -half_width_m to 1 at half_width_m from the
/// midplane.
double left_fraction(double x_m, double half_width_m);

/// Corrects two halves of a shape that were solved separately, so that left + right equals `whole`. `half_width_m`: see
/// left_fraction().
void share_the_rest(const Points& rest, const Points& whole, double half_width_m, Points& left,
                    Points& right);

}  // namespace risorius::blendshapes
