// SPDX-License-Identifier: MIT
/// \file
/// The muscles of face and jaw: their parameters as Hill-type muscles, and their paths. Names are those of
/// rigs/standard/muscles.json; lengths are those of the atlas head.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/track/channels.h"

namespace risorius::rig {

/// A point of a muscle path, in a form that can be placed on any head: p = sum of weight * landmark + offset * head size. If a
/// depth is given, p is a point on the skin and the path runs below it; if not, p is the point of the path itself.
struct PathPoint {
    /// The body that the point moves with.
    enum class Body { kSkull, kMandible, kHyoid, kEyelid, kNeck, kSoft };

    Vec3 atlas = Vec3::Zero();                              ///< on the atlas head, m
    std::vector<std::pair<std::string, double>> landmarks;  ///< weights add up to 1
    Vec3 offset = Vec3::Zero();                             ///< m, at atlas size
    /// Depth below the skin as a fraction of the tissue thickness, [0, 1.2]; negative: not given
    double depth = -1;
    Body body = Body::kSoft;
    std::string attach;  ///< bone, dermis, modiolus, raphe, via, none...

    bool on_skin() const { return depth >= 0; }
};
using MusclePath = std::vector<PathPoint>;  ///< from origin to insertion, at least two points

/// A muscle and its parameters.
struct Muscle {
    std::string id;
    std::string name;
    std::string group;  ///< mimetic, lid, jaw, hyoid
    std::string action;
    bool paired = true;
    double activation_s = 0.025;  ///< time constant of rising activation
    double deactivation_s = 0.045;
    double force_n = 1.0;  ///< maximum isometric force per side
    bool tonic = false;    ///< has a resting tone that can be reduced: excitation may go down to -1

    // The following are given for muscles of jaw and hyoid, and for others where the table has them; 0 or empty: not given.
    double width_m = 0, thickness_m = 0;  ///< size of the belly
    double area_m2 = 0;                   ///< physiological cross-sectional area per side
    double optimal_length_m = 0;          ///< optimal length of the fibres
    double tendon_slack_m = 0;            ///< slack length of both tendons together
    double pennation_deg = 0;             ///< at optimal length
    double max_speed_hz = 10;             ///< maximum speed, optimal lengths per second
    /// Fibre length over optimal length, with the face at rest and the jaw closed
    double rest_stretch = 1;
    double max_shortening = 0.3;    ///< published value, fraction of the optimal length
    std::vector<MusclePath> paths;  ///< on the left side, or from left to right across the midline
};

/// Returns the path on the other side, with mirrored landmarks and offsets.
MusclePath mirrored(const MusclePath& path);

/// All muscles of a rig.
struct MuscleTable {
    std::vector<Muscle> muscles;
    track::ChannelTable channels() const;
    Eigen::VectorXd activation_s() const;    ///< one per column
    Eigen::VectorXd deactivation_s() const;  ///< one per column
};

MuscleTable read_muscle_table(JsonCursor json);

}  // namespace risorius::rig
