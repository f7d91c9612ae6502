// Every muscle of the face and jaw: its properties as a Hill-type muscle. Names are those of rigs/standard/muscles.json.
#pragma once

#include <string>
#include <vector>

#include "core/json_cursor.h"
#include "track/channels.h"

namespace risorius::rig {

struct Muscle {
    std::string id;
    std::string name;
    std::string group;  ///< mimetic, lid, jaw, hyoid
    std::string action;
    bool paired = true;
    double activation_s = 0.025;  ///< time constant of rising activation
    double deactivation_s = 0.045;
    double force_n = 1.0;  ///< isometric, per side
    bool tonic = false;    ///< has resting drive that can be taken away: excitation down to -1
};

struct MuscleTable {
    std::vector<Muscle> muscles;
    track::ChannelTable channels() const;
    Eigen::VectorXd activation_s() const;    ///< per column
    Eigen::VectorXd deactivation_s() const;  ///< per column
};

MuscleTable read_muscle_table(JsonCursor json);

}  // namespace risorius::rig
