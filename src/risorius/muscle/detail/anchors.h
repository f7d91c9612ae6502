// SPDX-License-Identifier: MIT
/// \file
/// Anchors, to which the ends of a muscle are attached: points of a plate across the end, a plane, points of a bone, or
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
    /// Zero for an anchor of points: tendons end at the points. For a plane, its unit normal out of the belly: tendons are
    /// perpendicular to the plane through their point, and may meet it beside the point.
    Vec3 normal = Vec3::Zero();

    bool is_plane() const { return !normal.isZero(); }
    Rigid at(double t_s) const { return motion ? motion(t_s) : Rigid::Identity(); }
};

/// The anchors of both ends of a muscle.
struct Anchors {
    Anchor origin, insertion;
};

/// Unit vector out of the belly at an end: the mean direction of its outermost segments.
Vec3 outward_at(End end, const tissue::GridShape& grid, const Points& rest);
/// Points of a plate across an end of a belly in its rest shape, at the distance `away_m` along outward_at.
Anchor planar_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// The same as planar_anchor(), but as a plane (is_plane()).
Anchor plane_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m);
/// Plates of points for both ends, each at half the slack length.
Anchors planar_anchors(const tissue::GridShape& grid, const Points& rest, double tendon_slack_m);
/// Anchor at points of a bone. `bone` has one point for all chains, one per chain (N O), or the points of a polyline along
/// which the ends of the tendons are evenly spaced in the order of a2. In the rest shape the tendons have their slack length.
/// Throws std::invalid_argument without points.
Anchor bone_anchor(End end, const tissue::GridShape& grid, const Points& rest, const Points& bone);

}  // namespace risorius::muscle
