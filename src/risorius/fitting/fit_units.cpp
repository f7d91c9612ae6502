// SPDX-License-Identifier: MIT
#include "risorius/fitting/fit_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "risorius/scene/unit_reader.h"

namespace risorius::fitting {

namespace {

constexpr double kNearEnough = 0.03;          // of the gain
constexpr double kLeast = 0.2, kLargest = 5;  // factors
constexpr double kNothing = 0.02;  // a smaller gain: muscles that this face does not simulate
constexpr int kScalings = 5;
constexpr double kEven = 0.01;  // of the response
constexpr std::array<double, 3> kIntensities{0.25, 0.5, 0.75};

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
        out.curve = even_curve(out);
        out.reached = std::round(1e2 * out.reached) / 1e2;
        return out;
    }

  private:
    double gain(double activation) {
        track::Expansion sum = none_;
        sum.add(whole_, activation);
        return reader_.gain(unit_, sum);
    }

    // Inverts the response, measured at three activations.
    track::IntensityCurve even_curve(const rig::UnitGain& found) {
        std::array<double, 5> activation{0, 0, 0, 0, 1}, response{0, 0, 0, 0, 1};
        const std::array<double, 3> at = unit_.curve.points();
        for (std::size_t i = 0; i < at.size(); ++i) {
            activation[i + 1] = at[i];
            response[i + 1] = gain(at[i] * found.muscles) / found.reached;
            if (!(response[i + 1] > response[i] + kEven)) return unit_.curve;
        }
        if (response[3] > 1 - kEven) return unit_.curve;
        std::array<double, 3> even{};
        for (std::size_t i = 0; i < even.size(); ++i) {
            std::size_t k = 0;
            while (response[k + 1] < kIntensities[i]) ++k;
            const double part = (kIntensities[i] - response[k]) / (response[k + 1] - response[k]);
            even[i] = activation[k] + part * (activation[k + 1] - activation[k]);
            even[i] = std::round(1e3 * even[i]) / 1e3;
        }
        return track::IntensityCurve(even);
    }

    scene::UnitReader& reader_;
    const track::ActionUnit& unit_;
    track::Expansion whole_, none_;
};

}  // namespace

std::map<std::string, rig::UnitGain> fit_units(face::Face& face, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor) {
    std::vector<const track::ActionUnit*> units;
    for (const track::ActionUnit& unit : rig.facs.units)
        if (!unit.landmark_targets_mm.empty() && !unit.muscles.empty() &&
            moved_by_muscles_alone(unit))
            units.push_back(&unit);
    scene::UnitReader reader(face, rig);
    std::map<std::string, rig::UnitGain> out;
    std::size_t done = 0;
    for (const track::ActionUnit* unit : units) {
        monitor.report(static_cast<double>(done++) / static_cast<double>(units.size()), unit->id);
        const rig::UnitGain gain = UnitFit(reader, *unit, rig.channels()).fit();
        if (gain.reached > kNothing) out[unit->id] = gain;
    }
    return out;
}

}  // namespace risorius::fitting
