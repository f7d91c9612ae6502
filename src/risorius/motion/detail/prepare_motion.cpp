// SPDX-License-Identifier: MIT
// What is done to a recording before it becomes keys.
#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/motion/import_motion.h"
#include "risorius/signal/filter.h"

namespace risorius::motion {

namespace {

constexpr double kMostSmoothed = 500'000;  // samples: an hour at 120 a second
constexpr double kLids_hz = 15;            // a blink closes the lids in about 70 ms

std::string other_side(const std::string& name) {
    const auto swapped = [&](std::string_view one, std::string_view two) {
        return name.substr(0, name.size() - one.size()) + std::string(two);
    };
    if (name.ends_with("Left")) return swapped("Left", "Right");
    if (name.ends_with("Right")) return swapped("Right", "Left");
    if (name.ends_with(".l")) return swapped(".l", ".r");
    if (name.ends_with(".r")) return swapped(".r", ".l");
    return name;
}

void negate(RecordedTrack& track) {
    for (double& value : track.values) value = value == 0 ? 0 : -value;
}

void mirror(RecordedMotion& motion) {
    for (RecordedTrack& track : motion.tracks) {
        track.channel = other_side(track.channel);
        if (track.channel.find("yaw") != std::string::npos ||
            track.channel.find("roll") != std::string::npos)
            negate(track);
    }
}

void subtract_neutral(RecordedMotion& motion, const std::array<double, 2>& between_s) {
    std::vector<std::size_t> quiet;
    for (std::size_t i = 0; i < motion.times_s.size(); ++i)
        if (motion.seen[i] && motion.times_s[i] >= between_s[0] &&
            motion.times_s[i] <= between_s[1])
            quiet.push_back(i);
    if (quiet.empty())
        throw Error(
            option_name("neutral"),
            "a time with samples of the face, up to " + format_number(motion.times_s.back()) + " s",
            format_number(between_s[0]) + "-" + format_number(between_s[1]));
    for (RecordedTrack& track : motion.tracks) {
        std::vector<double> values;
        for (const std::size_t i : quiet) values.push_back(track.values[i]);
        std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                         values.end());
        const double median = values[values.size() / 2];
        for (double& value : track.values)
            value = track.is_angle() ? value - median : std::max(0.0, value - median);
    }
}

/// Adds samples without a face where the file has none for longer than holding and fading take.
void mark_gaps(RecordedMotion& motion, ImportReport& report) {
    if (motion.keyed) return;
    const double step_s = 1 / motion.fps;
    RecordedMotion out = motion;
    out.times_s.clear();
    out.seen.clear();
    for (RecordedTrack& track : out.tracks) track.values.clear();
    const auto add = [&](double time_s, bool seen, std::size_t from) {
        if (!out.times_s.empty() && time_s <= out.times_s.back()) return;
        out.times_s.push_back(time_s);
        out.seen.push_back(seen);
        for (std::size_t t = 0; t < out.tracks.size(); ++t)
            out.tracks[t].values.push_back(motion.tracks[t].values[from]);
    };
    for (std::size_t i = 0; i < motion.times_s.size(); ++i) {
        const double now_s = motion.times_s[i];
        if (i > 0 && now_s - motion.times_s[i - 1] > kHold_s + kFade_s + 1.5 * step_s) {
            const double last_s = motion.times_s[i - 1];
            for (const double at_s : {last_s + kHold_s, last_s + kHold_s + kFade_s, now_s - step_s})
                add(at_s, false, i - 1);
            report.notes.push_back(
                "no samples from " + format_number(std::round(1e3 * last_s) / 1e3) + " to " +
                format_number(std::round(1e3 * now_s) / 1e3) + " s: the face goes to rest");
        }
        add(now_s, motion.seen[i] != 0, i);
    }
    motion = std::move(out);
}

/// What is left of a value so long after the face was seen, or before it is.
double left_after(double without_s) {
    return std::clamp(1 - (without_s - kHold_s) / kFade_s, 0.0, 1.0);
}

/// Gives samples without a face the values of the last one with it, for a while.
void bridge(RecordedMotion& motion) {
    const std::size_t count = motion.times_s.size();
    std::size_t first = 0;
    while (!motion.seen[first]) ++first;
    for (RecordedTrack& track : motion.tracks) {
        std::size_t last = first;
        for (std::size_t i = 0; i < count; ++i) {
            if (motion.seen[i]) {
                last = i;
                continue;
            }
            track.values[i] =
                track.values[last] * left_after(std::abs(motion.times_s[i] - motion.times_s[last]));
        }
    }
}

bool is_of_lids(const std::string& channel) {
    return channel.starts_with("eyeBlink") || channel.starts_with("eyeWide") ||
           channel.starts_with("eyeSquint") || channel == "AU43" || channel == "AU45";
}

double value_at(const std::vector<double>& times_s, const std::vector<double>& values, double t_s) {
    const auto next = static_cast<std::size_t>(
        std::upper_bound(times_s.begin(), times_s.end(), t_s) - times_s.begin());
    if (next == 0) return values.front();
    if (next == times_s.size()) return values.back();
    const double share = (t_s - times_s[next - 1]) / (times_s[next] - times_s[next - 1]);
    return values[next - 1] + share * (values[next] - values[next - 1]);
}

void smooth(RecordedMotion& motion, double hz, ImportReport& report) {
    if (const double even = motion.times_s.back() * motion.fps; even > kMostSmoothed)
        throw Error(option_name("smooth"), "a recording of at most 500000 even samples",
                    format_number(std::round(even)));
    std::vector<double> grid_s;
    for (long i = 0; static_cast<double>(i) / motion.fps <= motion.times_s.back() + 1e-6; ++i)
        grid_s.push_back(static_cast<double>(i) / motion.fps);
    bool too_slow = false;
    for (RecordedTrack& track : motion.tracks) {
        std::vector<double> even;
        for (const double t_s : grid_s) even.push_back(value_at(motion.times_s, track.values, t_s));
        const double cutoff = is_of_lids(track.channel) ? std::max(hz, kLids_hz) : hz;
        const auto padding = static_cast<std::size_t>(3 * motion.fps / cutoff);
        if (track.channel.starts_with("gaze_") || track.channel.starts_with("eyeLook")) {
            // Saccades are faster than any filter that would help.
        } else if (cutoff < 0.49 * motion.fps && even.size() > padding) {
            even = signal::filter_both_ways(signal::low_pass(2, cutoff, motion.fps), even, padding);
        } else {
            too_slow = true;
        }
        track.values = std::move(even);
    }
    motion.times_s = std::move(grid_s);
    motion.seen.assign(motion.times_s.size(), 1);
    if (too_slow)
        report.notes.push_back(
            "some channels are not smoothed: the recording is too slow or short");
}

}  // namespace

void prepare_motion(RecordedMotion& motion, const ImportOptions& options, ImportReport& report) {
    report.samples = static_cast<int>(motion.times_s.size());
    report.lost = motion.lost;
    for (const char seen : motion.seen) report.unseen += seen ? 0 : 1;
    if (options.mirror) mirror(motion);
    for (const std::string& turn : options.invert) {
        index_of_name(option_name("invert"), turn, {"yaw", "pitch", "roll"});
        for (RecordedTrack& track : motion.tracks)
            if (track.is_angle() && track.channel.find(turn) != std::string::npos) negate(track);
    }
    if (options.neutral_s) subtract_neutral(motion, *options.neutral_s);
    double last_s = 0;
    bool was_seen = false;
    for (std::size_t i = 0; i < motion.times_s.size(); ++i) {
        was_seen = was_seen || motion.seen[i];
        if (motion.seen[i])
            last_s = motion.times_s[i];
        else if (was_seen && motion.times_s[i] - last_s > kHold_s + 1e-9)
            ++report.faded;
    }
    mark_gaps(motion, report);
    bridge(motion);
    if (options.smooth_hz > 0) smooth(motion, options.smooth_hz, report);
}

}  // namespace risorius::motion
