// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/expression_script.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace risorius::stimuli {

namespace {

bool is_unit(const std::string& channel) {
    return channel.size() > 2 && channel.starts_with("AU") &&
           std::isdigit(static_cast<unsigned char>(channel[2]));
}

/// The largest intensity in a script with expressions and units alone.
double largest_intensity(const Json& script) {
    double most = 0;
    for (const Json& event : script.at("events"))
        most = std::max(most, event.value("intensity", 1.0));
    for (const Json& channel : script.at("channels"))
        for (const Json& key : channel.at("keys")) most = std::max(most, key.at(1).get<double>());
    return most;
}

}  // namespace

std::optional<Json> expression_alone(Json script) {
    for (const char* key : {"weakness", "late_s", "view", "emg"}) script.erase(key);
    Json events = Json::array(), channels = Json::object();
    if (script.contains("events"))
        for (const Json& event : script.at("events"))
            if (event.contains("expression")) events.push_back(event);
    if (script.contains("channels"))
        for (const auto& [name, channel] : script.at("channels").items())
            if (is_unit(name) && channel.contains("keys")) channels[name] = channel;
    script["events"] = std::move(events);
    script["channels"] = std::move(channels);
    if (!(largest_intensity(script) > 0)) return {};
    return script;
}

std::optional<Json> expression_settled(const Json& script) {
    std::optional<Json> out = expression_alone(script);
    if (!out || !out->at("channels").empty() || out->at("events").size() != 1) return out;
    Json& event = (*out)["events"][0];
    event["start_s"] = 0;
    event["onset_s"] = 0.1;
    event["hold_s"] = 1;
    event["offset_s"] = 0.1;
    (*out)["duration_s"] = 0.5;
    (*out)["fps"] = 10;
    return out;
}

std::optional<Json> expression_at_full_intensity(const Json& script) {
    std::optional<Json> out = expression_settled(script);
    if (!out) return out;
    const double most = largest_intensity(*out);
    for (Json& event : (*out)["events"]) event["intensity"] = event.value("intensity", 1.0) / most;
    for (Json& channel : (*out)["channels"])
        for (Json& key : channel["keys"]) key[1] = key.at(1).get<double>() / most;
    return out;
}

}  // namespace risorius::stimuli
