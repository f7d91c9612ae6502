// SPDX-License-Identifier: MIT
#include "risorius/rig/expression_drive.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace risorius::rig {

namespace {

// Keeps values with a side only on that side, and half of the others.
track::Expansion one_side(track::Expansion whole, Side side, const track::ChannelTable& channels) {
    for (const track::MuscleChannel& muscle : channels.muscles) {
        const int left = channels.column(muscle.id, Side::kLeft),
                  right = channels.column(muscle.id, Side::kRight);
        if (left == right)
            whole.excitation[left] *= 0.5;
        else
            whole.excitation[side == Side::kLeft ? right : left] = 0;
    }
    for (double& value : whole.kinematic) value *= 0.5;
    return whole;
}

// A shape of ARKit, one side of it, or both of its sides.
std::optional<track::Expansion> shape_named(const rig::RigDescription& rig, const std::string& name,
                                            const track::ChannelTable& channels) {
    const SidedShape shape = split_shape(name);
    track::Expansion out = track::Expansion::none(channels);
    const auto add = [&](const std::string& arkit) {
        const track::ArkitShape* found = rig.facs.find_arkit(arkit);
        if (found) out.add(track::expand(*found, rig.facs, channels), 1.0);
        return found != nullptr;
    };
    if (add(name)) return out;
    if (shape.side && add(shape.base + (*shape.side == Side::kLeft ? "Left" : "Right"))) return out;
    if (shape.side && add(shape.base)) return one_side(out, *shape.side, channels);
    if (add(name + "Left") && add(name + "Right")) return out;
    return std::nullopt;
}

}  // namespace

SidedShape split_shape(const std::string& name) {
    for (const auto& [ending, side] : {std::pair{"_L", Side::kLeft},
                                       {"_R", Side::kRight},
                                       {"Left", Side::kLeft},
                                       {"Right", Side::kRight}}) {
        const std::string_view tail(ending);
        if (name.size() > tail.size() && name.ends_with(tail))
            return {name.substr(0, name.size() - tail.size()), side};
    }
    return {name, std::nullopt};
}

std::optional<track::Expansion> expansion_at(const rig::RigDescription& rig,
                                             const std::string& name, double intensity) {
    const track::ChannelTable channels = rig.channels();
    track::Expansion out = track::Expansion::none(channels);
    if (const std::vector<track::Kinematic> found = track::kinematic_named(name); !found.empty()) {
        for (const track::Kinematic k : found)
            out.kinematic[static_cast<std::size_t>(k)] = intensity;
        return out;
    }
    const track::SidedName sided = track::split_side(name);
    const auto add_unit = [&](const track::ActionUnit& unit, std::optional<Side> side,
                              double share) {
        out.add(track::expand(unit, side, channels), unit.curve, share);
    };
    if (const track::ActionUnit* whole = rig.facs.find(name)) {
        add_unit(*whole, std::nullopt, intensity);
        return out;
    }
    if (const track::ActionUnit* unit = rig.facs.find(sided.id)) {
        if (!unit->sided) return std::nullopt;
        add_unit(*unit, sided.side, intensity);
        return out;
    }
    if (const track::Expression* expression = rig.expressions.find(name)) {
        for (const track::ExpressionUnit& part : expression->parts.units)
            add_unit(*rig.facs.find(part.use.unit), part.use.side, intensity * part.use.value);
        for (const track::MuscleFraction& muscle : expression->parts.muscles)
            out.add(track::expand(muscle, channels), track::curve_of_added_muscles(), intensity);
        return out;
    }
    if (const track::MuscleChannel* muscle = channels.find(sided.id)) {
        if (sided.side && !muscle->paired) return std::nullopt;
        out.add(track::expand(track::MuscleFraction{sided.id, sided.side, 1.0}, channels),
                intensity);
        return out;
    }
    std::optional<track::Expansion> shape = shape_named(rig, name, channels);
    if (!shape) return std::nullopt;
    out.add(*shape, intensity);
    return out;
}

track::Drive clamped_drive(const track::Expansion& sum, const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = sum.excitation.cwiseMax(channels.column_min()).cwiseMin(1.0);
    for (int k = 0; k < track::kKinematicCount; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const track::KinematicChannel& channel = track::kinematic_channels()[at];
        drive.kinematic[at] = std::clamp(sum.kinematic[at], channel.min, channel.max);
    }
    return drive;
}

Json drive_json(const track::Drive& drive, const track::ChannelTable& channels) {
    Json out = Json::object();
    const std::vector<std::string> names = channels.column_names();
    for (std::size_t c = 0; c < names.size(); ++c)
        if (drive.excitation[static_cast<long>(c)] != 0)
            out[names[c]] = drive.excitation[static_cast<long>(c)];
    for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
        if (drive.kinematic[k] != 0)
            out[std::string(track::kinematic_channels()[k].name)] = drive.kinematic[k];
    return out;
}

}  // namespace risorius::rig
