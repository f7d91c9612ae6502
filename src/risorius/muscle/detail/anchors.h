// SPDX-License-Identifier: MIT
/// \file
/// What the ends of a muscle are tied to: points of plates across them, planes, points of bones, or nothing.
#pragma once

#include <functional>

#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::muscle {

enum class End { kOrigin, kInsertion };  ///< beside m = 0 and beside m = M - 1

/// What one end of a muscle is tied to: a point per chain on a rigid plate or bone.
struct Anchor {
    Points rest = {};  ///< N O x 3, m; chain n O + o. No rows: the end is free
    std::function<Rigid(double t_s)> motion =
        {};                        ///< of the plate from rest; empty: it stands still
    Eigen::VectorXd slack_m = {};  ///< of each tendon; empty: lTs shared by the anchored ends
    /// Zero: tendons end in the points. Otherwise of length 1, out of the belly: tendons stand square on planes through
    /// the points, wherever their nodes are beside them.
    Vec3 normal = Vec3::Zero();

    bool is_plane() const { return !normal.isZero(); }
    Rigid at(double t_s) const { return motion ? motion(t_s) : Rigid::Identity(); }
};

struct Anchors {
    Anchor origin, insertion;
};

/// Unit vector out of the belly at an end, the mean of its outermost segments'.
Vec3 outward_at(End end, const tissue::GridShape& grid, const Points& rest);
/// A plate across an end of a belly at rest, so far away along outward_at.
Anchor planar_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// The same plate as a plane.
Anchor plane_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// Both of points, half the slack length away.
Anchors planar_anchors(const tissue::GridShape& grid, const Points& rest, double tendon_slack_m);
/// Tendons, slack at rest, to points of a bone: one for all, one per chain (N O), or a line that is shared out evenly over
/// the width a2. Throws std::invalid_argument without points.
Anchor bone_anchor(End end, const tissue::GridShape& grid, const Points& rest, const Points& bone);

}  // namespace risorius::muscle
