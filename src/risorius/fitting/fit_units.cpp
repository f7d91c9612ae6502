// SPDX-License-Identifier: MIT
#include "risorius/fitting/fit_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "risorius/fitting/detail/fit_tolerance.h"
#include "risorius/scene/unit_reader.h"

namespace risorius::fitting {

namespace {

constexpr double kNearEnough = 0.005;         // of the gain
constexpr double kLeast = 0.2, kLargest = 5;  // factors
constexpr double kNothing = 0.02;  // a smaller gain: muscles that this face does not simulate
constexpr int kScalings = 5;
constexpr double kEven = 0.01;  // of the response
constexpr std::array<double, 3> kIntensities{0.25, 0.5, 0.75};

bool moves_channels(const track::ActionUnit& unit) {
    for (int k = 0; k < track::kKinematicCount; ++k)
        if (unit.kinematic[static_cast<std::size_t>(k)] != 0 &&
            track::has_curve(static_cast<track::Kinematic>(k)))
            return true;
    return false;
}

bool moved_by_muscles_alone(const track::ActionUnit& unit) {
    const bool still = std::all_of(unit.kinematic.begin(), unit.kinematic.end(),
                                   [](double value) { return value == 0; });
    return still && std::none_of(unit.muscles.begin(), unit.muscles.end(),
                                 [](const track::MuscleFraction& muscle) {
                                     return muscle.muscle == "levator_palpebrae_superioris";
                                 });
}

double largest_weight(const track::ActionUnit& unit) {
    double largest = 0;
    for (const track::MuscleFraction& muscle : unit.muscles)
        largest = std::max(largest, std::abs(muscle.weight));
    return largest;
}

class UnitFit {
  public:
    UnitFit(scene::UnitReader& reader, const track::ActionUnit& unit,
            const track::ChannelTable& channels)
        : reader_(reader),
          unit_(unit),
          whole_(track::expand(unit, std::nullopt, channels)),
          none_(track::Expansion::none(channels)) {}

    rig::UnitGain fit() {
        rig::UnitGain out;
        // The largest weight may become 1, and not more: the muscles of a unit keep their proportions
        const double most = std::clamp(1 / largest_weight(unit_), 1.0, kLargest);
        out.muscles = 1;
        out.reached = gain(1);
        // Regula falsi of log(gain) over log(factor): a gain grows more slowly than its factor
        double low = kLeast, high = most, slope = 0.6;
        for (int trial = 0; trial < kScalings && std::abs(out.reached - 1) > kNearEnough; ++trial) {
            if (!(out.reached > kNothing)) break;
            (out.reached < 1 ? low : high) = out.muscles;
            const double before = std::log(out.muscles), gain_before = std::log(out.reached);
            const double next = std::clamp(std::exp(before - gain_before / slope), low, high);
            if (std::abs(next - out.muscles) < 1e-3) break;
            const double reached = gain(next);
            if (reached > 0 && std::log(next) != before)
                slope = std::clamp((std::log(reached) - gain_before) / (std::log(next) - before),
                                   0.2, 2.0);
            if (std::abs(reached - 1) > std::abs(out.reached - 1) && trial > 1) break;
            out.muscles = next;
            out.reached = reached;
        }
        out.muscles = std::round(1e3 * out.muscles) / 1e3;
        return finish(out);
    }

    // Jaw and pressure go as far as the table says; they only get curves, so that chin and cheeks move evenly.
    rig::UnitGain fit_channels() {
        rig::UnitGain out;
        out.reached = gain(1);
        return finish(out);
    }

  private:
    double gain(double activation) {
        track::Expansion sum = none_;
        sum.add(whole_, activation);
        return reader_.gain(unit_, sum);
    }

    rig::UnitGain finish(rig::UnitGain out) {
        out.curve = unit_.curve;
        if (out.reached > kNothing) out.curve = even_curves(out);
        out.reached = std::round(1e2 * out.reached) / 1e2;
        return out;
    }

    // Inverts the response, measured at three intensities of the curves of the table.
    track::UnitCurves even_curves(const rig::UnitGain& found) {
        track::Expansion scaled = none_;
        scaled.add(whole_, 1.0);
        scaled.excitation *= found.muscles;
        std::array<double, 5> intensity{0, 0.25, 0.5, 0.75, 1}, response{0, 0, 0, 0, 1};
        for (std::size_t i = 1; i < 4; ++i) {
            track::Expansion sum = none_;
            sum.add(scaled, unit_.curve, intensity[i]);
            response[i] = reader_.gain(unit_, sum) / found.reached;
            if (!(response[i] > response[i - 1] + kEven)) return unit_.curve;
        }
        if (response[3] > 1 - kEven) return unit_.curve;
        std::array<double, 3> muscles{}, jaw{};
        const auto thousandths = [](double value) { return std::round(1e3 * value) / 1e3; };
        for (std::size_t i = 0; i < kIntensities.size(); ++i) {
            std::size_t k = 0;
            while (response[k + 1] < kIntensities[i]) ++k;
            const double part = (kIntensities[i] - response[k]) / (response[k + 1] - response[k]);
            const double at = intensity[k] + part * (intensity[k + 1] - intensity[k]);
            muscles[i] = thousandths(unit_.curve.muscles.activation(at));
            jaw[i] = thousandths(unit_.curve.channels.activation(at));
        }
        return {track::IntensityCurve(muscles),
                moves_channels(unit_) ? track::IntensityCurve(jaw) : unit_.curve.channels};
    }

    scene::UnitReader& reader_;
    const track::ActionUnit& unit_;
    track::Expansion whole_, none_;
};

}  // namespace

std::map<std::string, rig::UnitGain> fit_units(face::FaceTeam& team, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor) {
    std::vector<const track::ActionUnit*> units;
    for (const track::ActionUnit& unit : rig.facs.units)
        if (!unit.landmark_targets_mm.empty() && !unit.muscles.empty() &&
            (moved_by_muscles_alone(unit) || moves_channels(unit)))
            units.push_back(&unit);
    std::map<const face::Face*, std::unique_ptr<scene::UnitReader>> readers;
    team.all([&](face::Face& face) {
        readers.emplace(&face, std::make_unique<scene::UnitReader>(face, rig, kFitTolerance_m));
    });
    TaskProgress progress(monitor, static_cast<int>(units.size()));
    std::vector<rig::UnitGain> gains(units.size());
    team.each(static_cast<int>(units.size()), [&](int u, face::Face& face) {
        const track::ActionUnit& unit = *units[static_cast<std::size_t>(u)];
        progress.begin(unit.id);
        UnitFit fit(*readers.at(&face), unit, rig.channels());
        gains[static_cast<std::size_t>(u)] = moves_channels(unit) ? fit.fit_channels() : fit.fit();
    });
    std::map<std::string, rig::UnitGain> out;
    for (std::size_t u = 0; u < units.size(); ++u)
        if (gains[u].reached > kNothing) out[units[u]->id] = gains[u];
    return out;
}

}  // namespace risorius::fitting
