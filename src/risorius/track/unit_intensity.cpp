// SPDX-License-Identifier: MIT
#include "risorius/track/unit_intensity.h"

#include <algorithm>

#include "risorius/track/timeline.h"

namespace risorius::track {

UnitIntensity::UnitIntensity(const ScriptDescription& script, const FacsTable& facs)
    : expressions_(script.expressions), blinks_(script.blinks) {
    for (const ActionUnit& unit : facs.units) {
        if (!unit.unsupported.empty()) continue;
        units_.push_back({unit.id, static_cast<int>(names_.size()), unit.sided});
        if (unit.sided)
            for (const char* side : {".l", ".r"}) names_.push_back(unit.id + side);
        else
            names_.push_back(unit.id);
    }
    for (const ChannelTrack& channel : script.channels) {
        const SidedName sided = split_side(channel.name);
        UnitUse use;
        if (facs.find(channel.name))  // "AU30.l" is a unit of its own
            use = {channel.name, std::nullopt, 1};
        else if (facs.find(sided.id))
            use = {sided.id, sided.side, 1};
        else if (const ArkitShape* shape = facs.find_arkit(channel.name)) {
            for (const UnitUse& part : shape->units)
                tracks_.push_back({Curve(channel.keys, channel.interpolation), part});
            continue;
        } else
            continue;
        tracks_.push_back({Curve(channel.keys, channel.interpolation), std::move(use)});
    }
}

void UnitIntensity::add(const UnitUse& use, double fraction, std::vector<double>& sums) const {
    for (const Unit& unit : units_) {
        if (unit.id != use.unit) continue;
        const auto first = static_cast<std::size_t>(unit.first);
        if (!unit.sided || use.side != Side::kRight) sums[first] += fraction * use.value;
        if (unit.sided && use.side != Side::kLeft) sums[first + 1] += fraction * use.value;
    }
}

std::vector<double> UnitIntensity::at(double t_s) const {
    std::vector<double> sums(names_.size(), 0.0);
    for (const UnitTrack& track : tracks_) add(track.use, track.curve.at(t_s), sums);
    for (const ExpressionEvent& event : expressions_)
        for (const ExpressionEvent::Part& part : event.parts)
            add(part.use, expression_profile(event, part.delay, t_s), sums);
    for (const BlinkEvent& blink : blinks_)
        if (t_s >= blink.start_s && t_s < blink.start_s + blink.duration_s - kBlinkReopening_s)
            add({"AU45", blink.side, blink.intensity}, 1, sums);
    for (double& sum : sums) sum = std::clamp(sum, 0.0, 1.0);
    return sums;
}

}  // namespace risorius::track
