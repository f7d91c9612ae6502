// A blend shape: how far some vertices of a mesh move at weight 1. All others do not move at all.
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

/// The rows that are not zero.
SparseShape sparse(const Points& field);

/// What moves less than `none_m` does not move, what moves by `all_m` and more moves as it did, smoothly between:
/// a field that ends on a vertex would show as an edge. Where a fifth of `none_m` would be left nothing is.
struct Fade {
    double none_m = 5e-5, all_m = 1.5e-4;
};
void fade_out(Points& field, const Fade& fade = {});

/// How much of what happens at x belongs to the left side (x > 0): 0 to 1, smooth over 2 `half_width_m`.
double left_share(double x_m, double half_width_m);

/// Two halves of a whole, solved each by itself, get what is left of the whole where they meet: left + right is the whole.
void share_the_rest(const Points& rest, const Points& whole, double half_width_m, Points& left,
                    Points& right);

}  // namespace risorius::blendshapes
