// SPDX-License-Identifier: MIT
#include "risorius/track/detail/idle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "risorius/track/detail/curve.h"

namespace risorius::track {

namespace {

constexpr double kPi = 3.14159265358979323846;

// Blinks
constexpr double kIntervalSpread = 0.6;  // SD / mean: 3.1 s of 5.2 s
constexpr double kRefractory_s = 0.3;
constexpr std::array<double, 3> kPartialDepths{0.25, 0.5, 0.75};
// Saccades
constexpr double kFixationSpread = 0.3;
constexpr std::array<double, 8> kDirectionPercent{15.54, 6.46, 17.69, 7.44,
                                                  16.80, 7.89, 20.38, 7.80};  // for every 45 deg
constexpr int kTries = 8;
// Sway
constexpr double kSlowest_hz = 0.05, kFastest_hz = 1.5, kSlope = 1.5;
constexpr int kSines = 24;
constexpr double kFade_s = 1.0;
constexpr double kBreathPitch_deg = 0.2, kBreathLift_mm = 0.7;  // peak to peak
struct Axis {
    Kinematic channel;
    double spread;  ///< SD, deg or mm
};
constexpr std::array<Axis, 6> kAxes{{{Kinematic::kHeadYaw, 0.8},
                                     {Kinematic::kHeadPitch, 0.6},
                                     {Kinematic::kHeadRoll, 0.4},
                                     {Kinematic::kHeadSide, 1.5},
                                     {Kinematic::kHeadUp, 0.5},
                                     {Kinematic::kHeadForward, 1.5}}};

enum class Stream : unsigned { kBlinks = 1, kSaccades, kSway };

/// Random numbers that are the same with every standard library; std::normal_distribution does not promise that.
class Random {
  public:
    Random(const IdleEvent& event, Stream stream) {
        std::seed_seq seed{static_cast<unsigned>(event.seed), static_cast<unsigned>(event.number),
                           static_cast<unsigned>(stream)};
        engine_.seed(seed);
    }
    /// In (0, 1).
    double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
    double normal() {
        const double radius = std::sqrt(-2 * std::log(uniform()));
        return radius * std::cos(2 * kPi * uniform());
    }
    /// Lognormal (right-skewed) with the given mean and ratio of SD to mean.
    double lognormal(double mean, double spread) {
        const double variance = std::log1p(spread * spread);
        return mean * std::exp(std::sqrt(variance) * normal() - 0.5 * variance);
    }

  private:
    std::mt19937_64 engine_;
};

double optional_number(const JsonCursor& json, std::string_view key, double otherwise,
                       Range range) {
    const auto value = json.find(key);
    return value ? value->number(range) : otherwise;
}

Vec2 direction(Random& random) {
    double percent = 100 * random.uniform();
    std::size_t way = 0;
    while (way + 1 < kDirectionPercent.size() && percent > kDirectionPercent[way])
        percent -= kDirectionPercent[way++];
    const double angle =
        (45 * static_cast<double>(way) + 45 * (random.uniform() - 0.5)) * kPi / 180;
    return {std::cos(angle), std::sin(angle)};
}

std::vector<IdleSaccade> draw_saccades(const IdleEvent& event) {
    std::vector<IdleSaccade> saccades;
    const double reach = event.options.saccade_deg;
    if (reach == 0) return saccades;
    Random random(event, Stream::kSaccades);
    Vec2 gaze = Vec2::Zero();
    const double fixation = event.options.fixation_s;
    for (double t = event.start_s;;) {
        t +=
            std::clamp(random.lognormal(fixation, kFixationSpread), 0.5 * fixation, 1.5 * fixation);
        // Draws a direction and a size. Draws again when the target is out of reach; after kTries, the target is straight
        // ahead.
        Vec2 to = Vec2::Zero();
        for (int attempt = 0; attempt < kTries; ++attempt) {
            const double size = std::min(reach, -0.5 * reach * std::log(random.uniform()));
            const Vec2 aimed = gaze + size * direction(random);
            if (aimed.norm() > reach) continue;
            to = aimed;
            break;
        }
        const double duration = 0.022 + 0.0023 * (to - gaze).norm();
        // The gaze must return to its start before the end of the event, so that it does not jump afterwards.
        if (t + 2 * duration + fixation > event.end_s) break;
        saccades.push_back({t, duration, gaze, to});
        t += duration;
        gaze = to;
    }
    if (!gaze.isZero(0.0)) {
        const double duration = 0.022 + 0.0023 * gaze.norm();
        saccades.push_back({event.end_s - duration, duration, gaze, Vec2::Zero()});
    }
    return saccades;
}

}  // namespace

IdleOptions read_idle_options(const JsonCursor& json) {
    json.allow_keys({"blinks_per_minute", "partial_blinks", "saccade_deg", "fixation_s", "sway",
                     "breaths_per_minute"});
    IdleOptions out;
    out.blinks_per_minute =
        optional_number(json, "blinks_per_minute", out.blinks_per_minute, {0, 60});
    out.partial_blinks = optional_number(json, "partial_blinks", out.partial_blinks, {0, 1});
    out.saccade_deg = optional_number(json, "saccade_deg", out.saccade_deg, {0, 25});
    out.fixation_s = optional_number(json, "fixation_s", out.fixation_s, {0.1, 20});
    out.sway = optional_number(json, "sway", out.sway, {0, 5});
    out.breaths_per_minute =
        optional_number(json, "breaths_per_minute", out.breaths_per_minute, {0, 60});
    return out;
}

std::vector<IdleBlink> idle_blinks(const IdleEvent& event) {
    std::vector<IdleBlink> blinks;
    if (event.options.blinks_per_minute == 0) return blinks;
    Random random(event, Stream::kBlinks);
    const double mean = 60 / event.options.blinks_per_minute;
    // The event begins at a random place within an interval.
    double t = event.start_s + random.uniform() * random.lognormal(mean, kIntervalSpread);
    while (t < event.end_s) {
        double intensity = 1;
        if (random.uniform() < event.options.partial_blinks)
            intensity = kPartialDepths[static_cast<std::size_t>(3 * random.uniform())];
        blinks.push_back({t, intensity});
        t += std::max(kRefractory_s, random.lognormal(mean, kIntervalSpread));
    }
    return blinks;
}

IdleMotion::IdleMotion(const IdleEvent& event) : event_(event), saccades_(draw_saccades(event)) {
    Random random(event, Stream::kSway);
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        std::vector<Sine> sines;
        double power = 0;
        for (int k = 0; k < kSines; ++k) {
            // Frequencies are spread evenly over log f, each at a random place within its part, so that the motion does not
            // repeat.
            const double place = (k + random.uniform()) / kSines;
            const double hz = kSlowest_hz * std::pow(kFastest_hz / kSlowest_hz, place);
            const double amplitude = std::pow(hz, 0.5 * (1 - kSlope));
            sines.push_back({hz, amplitude, 2 * kPi * random.uniform()});
            power += 0.5 * amplitude * amplitude;
        }
        for (Sine& sine : sines) sine.amplitude *= kAxes[axis].spread / std::sqrt(power);
        sway_.push_back(std::move(sines));
    }
}

Vec2 IdleMotion::gaze(double t_s) const {
    const auto next =
        std::upper_bound(saccades_.begin(), saccades_.end(), t_s,
                         [](double t, const IdleSaccade& saccade) { return t < saccade.start_s; });
    if (next == saccades_.begin()) return Vec2::Zero();
    const IdleSaccade& last = *std::prev(next);
    return last.from_deg +
           minimum_jerk((t_s - last.start_s) / last.duration_s) * (last.to_deg - last.from_deg);
}

KinematicValues IdleMotion::at(double t_s) const {
    KinematicValues out{};
    if (t_s < event_.start_s || t_s > event_.end_s) return out;
    const auto add = [&](Kinematic k, double value) { out[static_cast<std::size_t>(k)] += value; };
    const Vec2 looks = gaze(t_s);
    add(Kinematic::kGazeYawLeft, looks.x());
    add(Kinematic::kGazeYawRight, looks.x());
    add(Kinematic::kGazePitchLeft, looks.y());
    add(Kinematic::kGazePitchRight, looks.y());

    const double fade = std::min(kFade_s, 0.5 * (event_.end_s - event_.start_s));
    const double shown =
        minimum_jerk(std::min(t_s - event_.start_s, event_.end_s - t_s) / std::max(fade, 1e-9));
    for (std::size_t axis = 0; axis < kAxes.size() && event_.options.sway > 0; ++axis) {
        double sum = 0;
        for (const Sine& sine : sway_[axis])
            sum += sine.amplitude * std::sin(2 * kPi * sine.hz * t_s + sine.phase);
        add(kAxes[axis].channel, shown * event_.options.sway * sum);
    }
    if (event_.options.breaths_per_minute > 0) {
        const double breath = 0.5 * (1 - std::cos(2 * kPi * event_.options.breaths_per_minute / 60 *
                                                  (t_s - event_.start_s)));
        add(Kinematic::kHeadPitch, shown * kBreathPitch_deg * breath);
        add(Kinematic::kHeadUp, shown * kBreathLift_mm * breath);
    }
    return out;
}

}  // namespace risorius::track
