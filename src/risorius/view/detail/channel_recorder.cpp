// SPDX-License-Identifier: MIT
#include "risorius/view/detail/channel_recorder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/json_object.h"
#include "risorius/track/channels.h"
#include "risorius/view/detail/pull_recorder.h"

namespace risorius::view {

namespace {

constexpr double kFrame_s = 1.0 / 60, kSameTime_s = 1e-3;

double rounded_to(double value, double places) { return std::round(value * places) / places + 0.0; }

Json key_json(double t_s, double value) {
    return Json::array({rounded_to(t_s, 1e4), rounded_to(value, 1e3)});
}

/// The range of a channel, which may name a side.
double range_of(const std::string& channel) {
    for (const track::KinematicChannel& one : track::kinematic_channels())
        if (one.name == channel || one.name == channel + ".l") return one.max - one.min;
    return 1;
}

/// The keys of a channel after a recording.
Json merged_keys(const std::vector<track::Key>& recorded, const track::ChannelTrack* before,
                 double duration_s) {
    const double from_s = recorded.front().time_s, to_s = recorded.back().time_s;
    std::optional<track::Curve> curve;
    if (before) curve.emplace(before->keys, before->interpolation);
    const auto earlier = [&](double t_s) { return curve ? curve->at(t_s) : 0.0; };
    Json keys = Json::array();
    const double first_s = from_s - kFrame_s, last_s = to_s + kFrame_s;
    if (before)
        for (const track::Key& key : before->keys)
            if (key.time_s < first_s - kSameTime_s) keys.push_back(key_json(key.time_s, key.value));
    if (first_s >= 0) keys.push_back(key_json(first_s, earlier(first_s)));
    for (const track::Key& key : recorded) keys.push_back(key_json(key.time_s, key.value));
    if (last_s <= duration_s) keys.push_back(key_json(last_s, earlier(last_s)));
    if (before)
        for (const track::Key& key : before->keys)
            if (key.time_s > last_s + kSameTime_s) keys.push_back(key_json(key.time_s, key.value));
    return keys;
}

std::shared_ptr<const Json> shared(Json json) {
    return std::make_shared<const Json>(std::move(json));
}

}  // namespace

double thinned_to(double range) {
    constexpr double kRatios = 2.5, kUnits = 20;
    return kThinned * (range <= kRatios ? 1 : range / kUnits);
}

// Each round adds the worst sample of every gap between two keys.
std::vector<track::Key> thinned_keys(const std::vector<track::Key>& samples, double tolerance,
                                     track::Interpolation interpolation) {
    if (samples.size() < 3) return samples;
    std::vector<char> kept(samples.size(), 0);
    kept.front() = kept.back() = 1;
    for (bool added = true; added;) {
        added = false;
        std::vector<track::Key> keys;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (kept[i]) keys.push_back(samples[i]);
        const track::Curve curve(keys, interpolation);
        double worst = tolerance;
        std::size_t at = 0;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const double off = std::abs(curve.at(samples[i].time_s) - samples[i].value);
            if (!kept[i] && off > worst) {
                worst = off;
                at = i;
            }
            if (!kept[i] || at == 0) continue;
            kept[at] = 1;
            added = true;
            at = 0;
            worst = tolerance;
        }
    }
    std::vector<track::Key> out;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (kept[i]) out.push_back(samples[i]);
    return out;
}

std::vector<Operation> recording_edits(const Recording& recording, const Json& script,
                                       const track::ScriptDescription& read) {
    std::vector<Operation> out;
    if (!recording.channels.empty() && !script.contains("channels"))
        out.push_back({"/channels", shared(Json::object()), {}});
    for (const auto& [name, samples] : recording.channels) {
        const auto found =
            std::find_if(read.channels.begin(), read.channels.end(),
                         [&called = name](const auto& one) { return one.name == called; });
        const bool known = found != read.channels.end() && script.contains("channels") &&
                           script["channels"].contains(name);
        const track::ChannelTrack* before = known ? &*found : nullptr;
        const auto way = before ? before->interpolation : track::Interpolation::kLinear;
        const Json keys = merged_keys(thinned_keys(samples, thinned_to(range_of(name)), way),
                                      before, read.header.duration_s);
        if (before)
            out.push_back({"/channels/" + name + "/keys", shared(keys), {}});
        else
            out.push_back({"/channels/" + name,
                           shared(json_object({{"keys", keys}, {"interpolation", "linear"}})),
                           {}});
    }
    std::size_t count = script.contains("pulls") ? script["pulls"].size() : 0;
    if (!recording.pulls.empty() && !script.contains("pulls"))
        out.push_back({"/pulls", shared(Json::array()), {}});
    for (const track::PullTrack& pull : recording.pulls)
        out.push_back({"/pulls/" + std::to_string(count++), shared(pull_json(pull)), {}});
    return out;
}

}  // namespace risorius::view
