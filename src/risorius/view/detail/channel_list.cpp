// SPDX-License-Identifier: MIT
#include "risorius/view/detail/channel_list.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/json_object.h"

namespace risorius::view {

namespace {

std::string group_of(const std::string& kinematic) {
    if (kinematic.starts_with("jaw")) return "jaw";
    if (kinematic.starts_with("gaze")) return "gaze";
    if (kinematic.starts_with("head")) return "head";
    return "mouth";
}

std::string unit_of(const std::string& kinematic) {
    for (const char* unit : {"deg", "mm", "pa"})
        if (kinematic.ends_with(std::string("_") + unit))
            return unit == std::string("pa") ? "Pa" : unit;
    return "";
}

/// "zygomaticus_major" as words.
std::string words(std::string id) {
    std::replace(id.begin(), id.end(), '_', ' ');
    if (!id.empty() && id[0] >= 'a' && id[0] <= 'z') id[0] = static_cast<char>(id[0] - 'a' + 'A');
    return id;
}

Json channel(const std::string& name, const char* group, const std::string& label, double min,
             double max, bool sided, const std::string& unit = "") {
    return json_object({{"name", name},
                        {"group", group},
                        {"label", label},
                        {"min", min},
                        {"max", max},
                        {"sided", sided},
                        {"unit", unit}});
}

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

}  // namespace

Json channel_list(const rig::RigDescription& rig) {
    Json out = Json::array();
    for (const track::ActionUnit& unit : rig.facs.units)
        if (unit.unsupported.empty())
            out.push_back(channel(unit.id, "units", unit.name, 0, 1, unit.sided));
    for (const track::MuscleChannel& muscle : rig.channels().muscles)
        out.push_back(
            channel(muscle.id, "muscles", words(muscle.id), muscle.min, 1, muscle.paired));
    std::set<std::string> known;
    for (const track::KinematicChannel& kinematic : track::kinematic_channels()) {
        std::string name(kinematic.name);
        const bool sided = name.ends_with(".l") || name.ends_with(".r");
        if (sided) name.resize(name.size() - 2);
        if (!known.insert(name).second) continue;
        const std::string unit = unit_of(name);
        const std::string label =
            unit.empty() ? name : name.substr(0, name.size() - unit.size() - 1);
        out.push_back(channel(name, group_of(name).c_str(), words(label), kinematic.min,
                              kinematic.max, sided, unit));
    }
    for (const track::ArkitShape& shape : rig.facs.arkit)
        out.push_back(channel(shape.name, "shapes", shape.name, 0, 1, false));
    return out;
}

Json curve_samples(const track::ScriptDescription& script) {
    Json out = Json::object();
    for (const track::ChannelTrack& one : script.channels) {
        const track::Curve curve(one.keys, one.interpolation);
        Json samples = Json::array();
        for (int i = 0; i < kCurveSamples; ++i)
            samples.push_back(
                rounded(curve.at(script.header.duration_s * i / (kCurveSamples - 1))));
        out[one.name] = std::move(samples);
    }
    return out;
}

Json recorded_samples(const track::ScriptDescription& script) {
    Json out = Json::object();
    for (const track::EmgTrack& one : script.emg) {
        const Json before = out.value(one.muscle, Json::array());
        Json samples = Json::array();
        for (int i = 0; i < kRecordedSamples; ++i) {
            const double t_s = script.header.duration_s * i / (kRecordedSamples - 1);
            const double added =
                before.empty() ? 0 : before[static_cast<std::size_t>(i)].get<double>();
            samples.push_back(rounded(added + one.excitation.at(t_s)));
        }
        out[one.muscle] = std::move(samples);
    }
    return out;
}

}  // namespace risorius::view
