// SPDX-License-Identifier: MIT
/// \file
/// Every muscle of the face and jaw: its properties as a Hill-type muscle, and its paths. Names are those of
/// rigs/standard/muscles.json; lengths are those of the atlas head.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/track/channels.h"

namespace risorius::rig {

/// A point of a muscle's path, given so that it can be placed on any head:
/// p = sum of weight * landmark + offset * head size. With a depth, p lies on the skin; without, on the path itself.
struct PathPoint {
    enum class Body {
        kSkull,
        kMandible,
        kHyoid,
        kEyelid,
        kNeck,
        kSoft
    };  ///< the body that it moves with

    Vec3 atlas = Vec3::Zero();                              ///< on the atlas head, m
    std::vector<std::pair<std::string, double>> landmarks;  ///< with weights that add up to 1
    Vec3 offset = Vec3::Zero();                             ///< m, at atlas size
    double depth = -1;  ///< ratio of the tissue thickness below the skin, [0, 1.2]; < 0: none given
    Body body = Body::kSoft;
    std::string attach;  ///< bone, dermis, modiolus, raphe, via, none...

    bool on_skin() const { return depth >= 0; }
};
using MusclePath = std::vector<PathPoint>;  ///< origin to insertion, two points or more

struct Muscle {
    std::string id;
    std::string name;
    std::string group;  ///< mimetic, lid, jaw, hyoid
    std::string action;
    bool paired = true;
    double activation_s = 0.025;  ///< time constant of rising activation
    double deactivation_s = 0.045;
    double force_n = 1.0;  ///< isometric, per side
    bool tonic = false;  ///< has tone at rest that can be reduced: the excitation may go down to -1

    // Given for muscles of jaw and hyoid, and for others where the table gives them; 0 or empty: not given
    double width_m = 0, thickness_m = 0;  ///< of the belly
    double area_m2 = 0;                   ///< physiological cross-section, per side
    double optimal_length_m = 0;          ///< of its fibres
    double tendon_slack_m = 0;            ///< both tendons together
    double pennation_deg = 0;             ///< at optimal length
    double max_speed_hz = 10;             ///< optimal lengths per second
    double rest_stretch = 1;        ///< fibre length / optimal length, face at rest and jaw closed
    double max_shortening = 0.3;    ///< published, ratio of the optimal length
    std::vector<MusclePath> paths;  ///< of the left side, or from left to right across the midline
};

/// The same path on the other side: landmarks and offsets mirrored.
MusclePath mirrored(const MusclePath& path);

struct MuscleTable {
    std::vector<Muscle> muscles;
    track::ChannelTable channels() const;
    Eigen::VectorXd activation_s() const;    ///< per column
    Eigen::VectorXd deactivation_s() const;  ///< per column
};

MuscleTable read_muscle_table(JsonCursor json);

}  // namespace risorius::rig
