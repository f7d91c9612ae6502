// SPDX-License-Identifier: MIT
// Names, angles and samples that all readers share.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/motion/detail/motion_readers.h"
#include "risorius/track/arkit_names.h"

namespace risorius::motion {

const RecordedTrack* RecordedMotion::find(const std::string& channel) const {
    for (const RecordedTrack& track : tracks)
        if (track.channel == channel) return &track;
    return nullptr;
}

namespace detail {

namespace {

std::string letters_of(std::string_view name) {
    std::string out;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// The names of ARKit, by the letters of every way to write them. Recordings ask for one in each frame.
std::map<std::string, std::string> known_spellings() {
    std::map<std::string, std::string> out;
    for (const std::string& known : track::arkit_names()) {
        out.emplace(letters_of(known), known);
        for (const std::string side : {"Left", "Right"})
            if (known.ends_with(side))
                out.emplace(letters_of(known.substr(0, known.size() - side.size()) + side[0]),
                            known);
    }
    return out;
}

constexpr double kLongest_s = 3600;    // of a script
constexpr double kLeastStep_s = 1e-6;  // of samples

/// The usual step of rising times.
double median_step(const std::vector<double>& times_s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times_s.size(); ++i) steps.push_back(times_s[i] - times_s[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

}  // namespace

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::string arkit_spelling(std::string_view name) {
    static const std::map<std::string, std::string> known = known_spellings();
    const auto found = known.find(letters_of(name));
    return found == known.end() ? std::string() : found->second;
}

std::array<double, 3> head_angles(const Mat3& turn) {
    const double yaw = std::atan2(turn(0, 2), turn(2, 2)),
                 pitch = std::asin(std::clamp(turn(1, 2), -1.0, 1.0)),
                 roll = -std::atan2(turn(1, 0), turn(1, 1));
    return {kDegree * yaw, kDegree * pitch, kDegree * roll};
}

void MotionBuilder::begin(double time_s, bool seen) {
    out_.times_s.push_back(time_s);
    out_.seen.push_back(seen);
    for (RecordedTrack& track : out_.tracks) track.values.push_back(0);
}

void MotionBuilder::set(const std::string& channel, double value) {
    for (RecordedTrack& track : out_.tracks)
        if (track.channel == channel) {
            track.values.back() = value;
            return;
        }
    RecordedTrack& track = out_.tracks.emplace_back();
    track.channel = channel;
    track.values.assign(out_.times_s.size(), 0);
    track.values.back() = value;
}

void MotionBuilder::set_head(const std::array<double, 3>& angles) {
    set("head_yaw_deg", angles[0]);
    set("head_pitch_deg", angles[1]);
    set("head_roll_deg", angles[2]);
}

void MotionBuilder::unmapped(const std::string& name) {
    if (unmapped_.insert(name).second) out_.unmapped.push_back(name);
}

RecordedMotion MotionBuilder::finish(const std::string& place, const std::string& format,
                                     double fps) {
    if (out_.times_s.empty()) throw Error(place, "samples of motion", "none");
    if (std::none_of(out_.seen.begin(), out_.seen.end(), [](char seen) { return seen != 0; }))
        throw Error(place, "a face in some sample", "none in any");
    if (out_.tracks.empty()) throw Error(place, "channels of a face", "none that is known");
    const double begin_s = out_.times_s.front();
    for (std::size_t i = 0; i < out_.times_s.size(); ++i) {
        out_.times_s[i] -= begin_s;
        if (i > 0 && !(out_.times_s[i] - out_.times_s[i - 1] >= kLeastStep_s))
            throw Error(place + ": sample " + std::to_string(i + 1), "times that rise",
                        format_number(out_.times_s[i]) + " s after " +
                            format_number(out_.times_s[i - 1]) + " s");
    }
    if (!(out_.times_s.back() <= kLongest_s))
        throw Error(place, "motion of at most an hour",
                    format_number(std::round(out_.times_s.back())) + " s");
    out_.format = format;
    const double step_s = out_.times_s.size() > 1 ? median_step(out_.times_s) : 1.0 / 30;
    // Times may be rounded; over all of them the rate is exact.
    const double whole_s = out_.times_s.back(), steps = std::round(whole_s / step_s);
    out_.fps = fps > 0 ? fps : steps > 0 ? steps / whole_s : 1 / step_s;
    for (std::size_t i = 1; i < out_.times_s.size(); ++i)
        out_.lost += std::max(
            0, static_cast<int>(std::lround((out_.times_s[i] - out_.times_s[i - 1]) / step_s)) - 1);
    settle_shapes(out_);
    return std::move(out_);
}

void settle_shapes(RecordedMotion& motion) {
    const bool has_gaze =
        std::any_of(motion.tracks.begin(), motion.tracks.end(), [](const RecordedTrack& track) {
            return track.channel.starts_with("gaze_") &&
                   std::any_of(track.values.begin(), track.values.end(),
                               [](double value) { return value != 0; });
        });
    const auto is_look = [](const RecordedTrack& track) {
        return track.channel.starts_with("eyeLook");
    };
    const auto is_gaze = [](const RecordedTrack& track) {
        return track.channel.starts_with("gaze_");
    };
    if (has_gaze && std::any_of(motion.tracks.begin(), motion.tracks.end(), is_look)) {
        std::erase_if(motion.tracks, is_look);
        motion.notes.push_back("the eyes follow their recorded angles, not the eyeLook shapes");
    } else if (std::any_of(motion.tracks.begin(), motion.tracks.end(), is_look)) {
        std::erase_if(motion.tracks, is_gaze);
    }
    const RecordedTrack* open = motion.find("jawOpen");
    int limited = 0;
    for (RecordedTrack& track : motion.tracks)
        if (track.channel == "mouthClose" && open != nullptr)
            for (std::size_t i = 0; i < track.values.size(); ++i)
                if (track.values[i] > open->values[i]) {
                    track.values[i] = open->values[i];
                    ++limited;
                }
    if (limited > 0)
        motion.notes.push_back("mouthClose was more than jawOpen in " + std::to_string(limited) +
                               " samples, and is limited to it");
}

}  // namespace detail
}  // namespace risorius::motion
