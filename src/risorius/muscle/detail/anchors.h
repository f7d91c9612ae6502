// SPDX-License-Identifier: MIT
/// \file
/// Anchors: what the ends of a muscle are attached to. These are points of plates across them, planes, points of bones, or
/// nothing.
#pragma once

#include <functional>

#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::muscle {

enum class End { kOrigin, kInsertion };  ///< near m = 0 and near m = M - 1

/// The anchor of one end of a muscle: a point for each chain, on a rigid plate or bone.
struct Anchor {
    Points rest = {};  ///< N O x 3, m; chain n O + o. No rows: the end is free
    /// Motion of the plate from its rest pose; empty: it stands still.
    std::function<Rigid(double t_s)> motion = {};
    Eigen::VectorXd slack_m = {};  ///< of each tendon; empty: the anchored ends divide lTs equally
    /// Zero: tendons end at the points. Otherwise a unit vector out of the belly: tendons are perpendicular to planes through
    /// the points, wherever their nodes lie beside the points.
    Vec3 normal = Vec3::Zero();

    bool is_plane() const { return !normal.isZero(); }
    Rigid at(double t_s) const { return motion ? motion(t_s) : Rigid::Identity(); }
};

struct Anchors {
    Anchor origin, insertion;
};

/// Unit vector out of the belly at an end: the mean direction of its outermost segments.
Vec3 outward_at(End end, const tissue::GridShape& grid, const Points& rest);
/// Points of a plate across an end of a belly in its rest shape, at the distance `away_m` along outward_at.
Anchor planar_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// The same plate as a plane.
Anchor plane_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// Plates of points for both ends, each half the slack length away.
Anchors planar_anchors(const tissue::GridShape& grid, const Points& rest, double tendon_slack_m);
/// Tendons, just slack in the rest shape, to points of a bone: one point for all chains, one per chain (N O), or a polyline
/// that is divided evenly over the width a2. Throws std::invalid_argument without points.
Anchor bone_anchor(End end, const tissue::GridShape& grid, const Points& rest, const Points& bone);

}  // namespace risorius::muscle
