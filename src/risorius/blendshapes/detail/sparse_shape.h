// SPDX-License-Identifier: MIT
/// \file
/// A blend shape: the displacement of some vertices of a mesh at weight 1. All other vertices do not move.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::blendshapes {

struct SparseShape {
    std::vector<int> vertex;  ///< ascending
    Points delta;             ///< one row per vertex above, m

    bool empty() const { return vertex.empty(); }
    void add_to(Points& vertices, double weight) const;
    Points dense(long vertices) const;  ///< V x 3
};

/// Keeps the rows that are not zero.
SparseShape sparse(const Points& field);

/// Removes displacements below `none_m`, keeps those above `all_m`, with a smooth transition: a field that ended abruptly would show as an
/// edge. Results below a fifth of `none_m` are removed.
struct Fade {
    double none_m = 5e-5, all_m = 1.5e-4;
};
void fade_out(Points& field, const Fade& fade = {});

/// Weight of the left side (x > 0) at x: 0 to 1, smooth over 2 `half_width_m`.
double left_fraction(double x_m, double half_width_m);

/// Corrects two halves that were solved separately, near where they meet, so that left + right is the whole.
void share_the_rest(const Points& rest, const Points& whole, double half_width_m, Points& left,
                    Points& right);

}  // namespace risorius::blendshapes
