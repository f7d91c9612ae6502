// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_sources.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/rig/expression_drive.h"

namespace risorius::inverse {

UnitSources::UnitSources(const scene::RigFiles& files, bool pressure, bool tongue)
    : channels_(files.rig.channels()) {
    add(files, "facs", true, pressure, tongue);
    add(files, "muscles", false, pressure, tongue);
    set_costs(files.rig.expressions);
    set_expressions(files.rig.expressions);
}

// What landmarks hardly tell apart, such as AU25 and AU16, prior knowledge does: the negative logarithm of the share of expressions
// that have a unit, with one more expression for it and one against it.
void UnitSources::set_costs(const track::Expressions& expressions) {
    constexpr double kOfMuscle = 4, kOfRarity = 0.5;
    std::map<std::string, int> count;
    for (const track::Expression& one : expressions.list) {
        std::set<std::string> units;
        for (const track::ExpressionUnit& unit : one.parts.units) units.insert(unit.use.unit);
        for (const std::string& unit : units) ++count[unit];
    }
    int most = 0;
    for (const auto& [unit, times] : count) most = std::max(most, times);
    for (UnitCandidate& one : candidates_)
        one.cost = one.is_unit ? 1 + kOfRarity * std::log((most + 1.0) / (count[one.name] + 1.0))
                               : kOfMuscle;
}

void UnitSources::set_expressions(const track::Expressions& expressions) {
    const auto add = [&](const track::ExpressionParts& parts) {
        std::vector<bool>& out = expressions_.emplace_back(candidates_.size(), false);
        for (std::size_t c = 0; c < candidates_.size(); ++c)
            for (const track::ExpressionUnit& unit : parts.units)
                if (candidates_[c].is_unit && unit.use.unit == candidates_[c].name) out[c] = true;
    };
    for (const track::Expression& one : expressions.list) {
        add(one.parts);
        for (const auto& variant : one.variants) add(variant.parts);
    }
}

int UnitSources::strangers(const std::set<std::size_t>& candidates) const {
    int least = 0;
    for (const std::size_t c : candidates) least += candidates_[c].is_unit;
    for (const std::vector<bool>& expression : expressions_) {
        int count = 0;
        for (const std::size_t c : candidates) count += candidates_[c].is_unit && !expression[c];
        least = std::min(least, count);
    }
    return least;
}

void UnitSources::add(const scene::RigFiles& files, const std::string& set, bool units,
                      bool pressure, bool tongue) {
    using track::Kinematic;
    const blendshapes::ShapeSet found = blendshapes::shape_set(files.rig, set, {}, files.place());
    for (const blendshapes::ShapeGoal& goal : found.goals) {
        const auto moves = [&](Kinematic k) { return goal.drive.at(k) != 0; };
        if ((!pressure && moves(Kinematic::kMouthPressure)) ||
            (!tongue && (moves(Kinematic::kTongueOut) || moves(Kinematic::kTongueUp))))
            continue;
        // Jaw and gaze alone are no muscles, and a muscle that relaxes is no channel.
        const bool alone = std::any_of(goal.drive.kinematic.begin(), goal.drive.kinematic.end(),
                                       [](double value) { return value != 0; }) ||
                           goal.drive.excitation.minCoeff() < 0;
        if (!units && alone) continue;
        const bool halves = goal.sides == blendshapes::Sides::kHalves;
        const std::string name = halves ? goal.whole : goal.name;
        auto known = std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& one) {
            return one.is_unit == units && one.name == name;
        });
        if (known == candidates_.end())
            known = candidates_.insert(candidates_.end(), UnitCandidate{name, {}, units, 1});
        known->sources.push_back(sources_.size());
        const track::ActionUnit* const unit =
            units ? files.rig.facs.find(track::split_side(goal.name).id) : nullptr;
        sources_.push_back({goal.name,
                            {goal.drive.excitation, goal.drive.kinematic},
                            halves ? (goal.left ? 0 : 1) : -1,
                            unit ? unit->curve : track::UnitCurves{}});
    }
}

Eigen::VectorXd UnitSources::weights_of(const track::ExpressionParts& parts,
                                        double intensity) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(count());
    for (const UnitCandidate& one : candidates_)
        for (const track::ExpressionUnit& unit : parts.units) {
            if (!one.is_unit || unit.use.unit != one.name) continue;
            for (const std::size_t s : one.sources) {
                const int side = sources_[s].side;
                if (unit.use.side && side >= 0 && side != (*unit.use.side == Side::kLeft ? 0 : 1))
                    continue;
                out[static_cast<long>(s)] = intensity * unit.use.value;
            }
        }
    return out;
}

track::Drive UnitSources::drive_of(const Eigen::VectorXd& weights) const {
    track::Expansion sum = track::Expansion::none(channels_);
    for (std::size_t s = 0; s < sources_.size(); ++s)
        if (const double w = weights[static_cast<long>(s)]; w > 0)
            sum.add(sources_[s].drives, sources_[s].curve, w);
    return rig::clamped_drive(sum, channels_);
}

track::Expansion UnitSources::change_of(std::size_t source, double weight) const {
    constexpr double kSecant = 0.1;
    const double step = weight + kSecant <= 1 ? kSecant : -kSecant;
    track::Expansion out = track::Expansion::none(channels_), before = out;
    out.add(sources_[source].drives, sources_[source].curve, weight + step);
    before.add(sources_[source].drives, sources_[source].curve, weight);
    out.add(before, -1);
    out.excitation /= step;
    for (double& value : out.kinematic) value /= step;
    return out;
}

}  // namespace risorius::inverse
