// SPDX-License-Identifier: MIT
#include "risorius/track/channels.h"

namespace risorius::track {

const std::array<KinematicChannel, kKinematicCount>& kinematic_channels() {
    static constexpr std::array<KinematicChannel, kKinematicCount> kChannels{{
        {"jaw_open", 0, 1.2},
        {"jaw_forward", 0, 1},
        {"jaw_side", -1, 1},
        {"gaze_yaw_deg.l", -50, 50},
        {"gaze_yaw_deg.r", -50, 50},
        {"gaze_pitch_deg.l", -50, 50},
        {"gaze_pitch_deg.r", -50, 50},
        {"head_yaw_deg", -75, 75},
        {"head_pitch_deg", -55, 65},
        {"head_roll_deg", -42, 42},
        {"head_forward_mm", -60, 80},
        {"head_up_mm", -200, 200},
        {"head_side_mm", -200, 200},
        {"mouth_pressure_pa", -5000, 5000},
        {"tongue_out", 0, 1},
        {"tongue_up", -1, 1},
        {"tongue_body_up", -1, 1},
        {"tongue_body_back", -1, 1},
    }};
    return kChannels;
}

std::vector<Kinematic> kinematic_named(std::string_view name) {
    std::vector<Kinematic> found;
    const auto& channels = kinematic_channels();
    for (std::size_t k = 0; k < channels.size(); ++k) {
        const std::string_view full = channels[k].name;
        const bool sided = full.size() > 2 && full[full.size() - 2] == '.';
        if (full == name || (sided && full.substr(0, full.size() - 2) == name))
            found.push_back(static_cast<Kinematic>(k));
    }
    return found;
}

SidedName split_side(std::string_view name) {
    if (name.ends_with(".l")) return {std::string(name.substr(0, name.size() - 2)), Side::kLeft};
    if (name.ends_with(".r")) return {std::string(name.substr(0, name.size() - 2)), Side::kRight};
    return {std::string(name), std::nullopt};
}

const MuscleChannel* ChannelTable::find(const std::string& id) const {
    for (const MuscleChannel& muscle : muscles)
        if (muscle.id == id) return &muscle;
    return nullptr;
}

Eigen::VectorXd ChannelTable::column_min() const {
    Eigen::VectorXd min(column_count());
    int column = 0;
    for (const MuscleChannel& muscle : muscles)
        for (int side = 0; side < (muscle.paired ? 2 : 1); ++side) min[column++] = muscle.min;
    return min;
}

int ChannelTable::column_count() const {
    int count = 0;
    for (const MuscleChannel& muscle : muscles) count += muscle.paired ? 2 : 1;
    return count;
}

int ChannelTable::column(const std::string& id, Side side) const {
    int column = 0;
    for (const MuscleChannel& muscle : muscles) {
        if (muscle.id == id) return muscle.paired && side == Side::kRight ? column + 1 : column;
        column += muscle.paired ? 2 : 1;
    }
    return -1;
}

std::vector<std::string> ChannelTable::column_names() const {
    std::vector<std::string> names;
    for (const MuscleChannel& muscle : muscles) {
        if (!muscle.paired) {
            names.push_back(muscle.id);
        } else {
            names.push_back(muscle.id + ".l");
            names.push_back(muscle.id + ".r");
        }
    }
    return names;
}

}  // namespace risorius::track
