// SPDX-License-Identifier: MIT
/// \file
/// The muscles of a face at rest as lines of action with the parameters of Hill's model, for programs that know muscles as paths: the mean
/// of the fibres of each bundle and of each volume muscle, and the paths of the muscles of jaw and hyoid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/muscle_force.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::face {

struct FaceImpl;

/// One bundle, one side of a volume muscle, or one line of action between bones.
struct MuscleLine {
    struct Point {
        Vec3 rest;                                                ///< m, head frame
        rig::PathPoint::Body body = rig::PathPoint::Body::kSoft;  ///< that the point moves with
    };
    std::string muscle;        ///< its id in the muscle table
    std::optional<Side> side;  ///< empty: the muscle crosses the midline
    int part = 1;              ///< counts the bundles of one side of a muscle
    int column = 0;            ///< of the activation vector
    rig::MuscleModel model = rig::MuscleModel::kBundles;
    std::vector<Point> path;  ///< from origin to insertion
    double f0_n = 0;          ///< maximum isometric force of all its fibres, N
    double optimal_m = 0;     ///< optimal length of the fibres, m
    double slack_m = 0;       ///< slack length of the tendons, m
    double pennation_rad = 0;
    double max_speed_hz = 10;  ///< optimal lengths per second
    double activation_s = 0, deactivation_s = 0;
};

/// The jaw as one hinge, for programs without the condyles' paths.
struct JawHinge {
    Vec3 centre = Vec3::
        Zero();  ///< the middle between the condyles, m, head frame; the axis goes to the left
    double open_rad = 0;  ///< greatest opening of the channel jaw_open
    double mandible_kg = 0;
};
JawHinge jaw_hinge_of(const FaceImpl& face);

/// Returns the lines in the order of the columns. Jaw and hyoid have theirs whether muscles or channels move the jaw.
std::vector<MuscleLine> lines_of(const FaceImpl& face);

}  // namespace risorius::face
