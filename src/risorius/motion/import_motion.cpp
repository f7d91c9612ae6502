// SPDX-License-Identifier: MIT
#include "risorius/motion/import_motion.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/motion/reduce_keys.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::motion {

namespace fs = std::filesystem;

namespace {

constexpr double kDegreesPerWeight = 10;  // of the tolerance
constexpr double kLongest_s = 3600;       // of a script
constexpr int kUsualFps = 60, kLeastFps = 24, kMostFps = 240;

void check(const ImportOptions& options) {
    if (!(options.tolerance >= 0 && options.tolerance <= 1))
        throw Error(option_name("tolerance"), "a number in [0, 1]",
                    format_number(options.tolerance));
    if (!(options.smooth_hz >= 0 && options.smooth_hz <= 1000))
        throw Error(option_name("smooth"), "a frequency in [0, 1000]",
                    format_number(options.smooth_hz));
    if (!(options.read.fps >= 0 && options.read.fps <= 1000))
        throw Error(option_name("fps"), "a rate in [0, 1000]", format_number(options.read.fps));
    if (options.neutral_s &&
        !((*options.neutral_s)[0] >= 0 && (*options.neutral_s)[1] >= (*options.neutral_s)[0]))
        throw Error(
            option_name("neutral"), "begin and end of a time, s",
            format_number((*options.neutral_s)[0]) + "-" + format_number((*options.neutral_s)[1]));
}

/// Whether a rig has a channel of this name that can move.
bool has_channel(const rig::RigDescription& rig, const std::string& name) {
    if (!track::kinematic_named(name).empty() || rig.facs.find_arkit(name)) return true;
    const track::SidedName muscle = track::split_side(name);
    const track::ChannelTable table = rig.channels();
    if (const track::MuscleChannel* found = table.find(muscle.id))
        return found->paired || !muscle.side;
    const track::ActionUnit* unit = rig.facs.find(name);
    return unit != nullptr && unit->unsupported.empty();
}

Range range_of(const std::string& name) {
    const std::vector<track::Kinematic> which = track::kinematic_named(name);
    if (which.empty()) return {0, 1};
    const track::KinematicChannel& channel =
        track::kinematic_channels()[static_cast<std::size_t>(which.front())];
    return {channel.min, channel.max};
}

/// Both eyes become one channel where they move alike.
void join_sides(RecordedMotion& motion) {
    for (std::size_t i = 0; i < motion.tracks.size(); ++i) {
        RecordedTrack& left = motion.tracks[i];
        if (!left.channel.ends_with(".l")) continue;
        const std::string both = left.channel.substr(0, left.channel.size() - 2);
        const auto right = std::find_if(
            motion.tracks.begin(), motion.tracks.end(), [&](const RecordedTrack& other) {
                return other.channel == both + ".r" && other.values == left.values;
            });
        if (right == motion.tracks.end()) continue;
        left.channel = both;
        motion.tracks.erase(right);
        i = static_cast<std::size_t>(-1);  // begin again: places have moved
    }
}

double rounded(double value, double unit) {
    const double out = std::round(value / unit) * unit;
    return std::round(1e6 * out) / 1e6 + 0.0;
}

/// The channels of the script; fills the report.
Json channels_of(const RecordedMotion& motion, const rig::RigDescription& rig, double tolerance,
                 ImportReport& report) {
    Json out = Json::object();
    for (const RecordedTrack& track : motion.tracks) {
        if (!has_channel(rig, track.channel)) {
            report.unmapped.push_back(track.channel);
            continue;
        }
        const Range range = range_of(track.channel);
        std::vector<double> values;
        int beyond = 0;
        for (const double value : track.values) {
            beyond += value < range.min - 1e-6 || value > range.max + 1e-6;
            values.push_back(std::clamp(value, range.min, range.max));
        }
        if (beyond > 0)
            report.notes.push_back(track.channel + ": " + std::to_string(beyond) +
                                   " values outside of " + format_number(range.min) + " to " +
                                   format_number(range.max) + " are limited");
        const double most = tolerance * (track.is_angle() ? kDegreesPerWeight : 1);
        const auto [min, max] = std::minmax_element(values.begin(), values.end());
        if (std::max(std::abs(*min), std::abs(*max)) <= most) {
            ++report.still;
            continue;
        }
        Json keys = Json::array();
        for (const track::Key& key : reduce_keys(motion.times_s, values, most))
            keys.push_back({rounded(key.time_s, 1e-6), rounded(key.value, 1e-5)});
        report.channels.push_back({track.channel, *min, *max, static_cast<int>(keys.size())});
        Json channel = json_object({{"keys", std::move(keys)}, {"interpolation", "linear"}});
        if (track::kinematic_named(track.channel).empty()) channel["activation"] = true;
        out[track.channel] = std::move(channel);
    }
    return out;
}

}  // namespace

long ImportReport::keys() const {
    long sum = 0;
    for (const ImportedChannel& channel : channels) sum += channel.keys;
    return sum;
}

long ImportReport::values() const {
    return static_cast<long>(samples) * static_cast<long>(channels.size());
}

Json ImportReport::json() const {
    Json listed = Json::array();
    for (const ImportedChannel& channel : channels)
        listed.push_back(json_object({{"name", channel.name},
                                      {"min", channel.min},
                                      {"max", channel.max},
                                      {"keys", channel.keys}}));
    return json_object({{"format", "risorius-import"},
                        {"version", 1},
                        {"file", file},
                        {"script", script},
                        {"as", format},
                        {"fps", fps},
                        {"duration_s", duration_s},
                        {"samples", samples},
                        {"lost", lost},
                        {"unseen", unseen},
                        {"faded", faded},
                        {"values", values()},
                        {"keys", keys()},
                        {"channels", std::move(listed)},
                        {"still", still},
                        {"unmapped", unmapped},
                        {"notes", notes}});
}

ImportReport import_motion(const ImportOptions& options) {
    check(options);
    const rig::RigDescription rig = rig::read_rig(options.rig);
    RecordedMotion motion = read_motion(options.file, options.read);
    ImportReport report;
    report.file = options.file.generic_string();
    report.script = options.out.generic_string();
    report.format = motion.format;
    report.unmapped = motion.unmapped;
    report.notes = motion.notes;
    prepare_motion(motion, options, report);
    join_sides(motion);
    const long rate = std::lround(motion.fps);
    const int fps = rate >= kLeastFps && rate <= kMostFps ? static_cast<int>(rate) : kUsualFps;
    report.fps = motion.fps;
    report.duration_s = motion.times_s.back() + 1.0 / fps;
    if (report.duration_s > kLongest_s)
        throw Error(options.file.string(), "motion of at most an hour",
                    format_number(std::round(report.duration_s)) + " s");
    Json channels = channels_of(motion, rig, options.tolerance, report);
    const char* how = options.motion == track::Motion::kDynamic ? "dynamic" : "quasi_static";
    const Json script = json_object(
        {{"format", "risorius-script"},
         {"version", 1},
         {"rig",
          fs::absolute(options.rig)
              .lexically_normal()
              .lexically_proximate(fs::absolute(options.out).lexically_normal().parent_path())
              .generic_string()},
         {"fps", fps},
         {"duration_s", rounded(report.duration_s, 1e-6)},
         {"motion", how},
         {"channels", std::move(channels)}});
    write_file(options.out, json_text(script, 1) + "\n");
    return report;
}

}  // namespace risorius::motion
