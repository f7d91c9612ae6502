// SPDX-License-Identifier: MIT
#include "risorius/talk/speak_script.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"

namespace risorius::talk {

namespace {

constexpr double kRest_s = 0.05;  // of a face at rest before it moves

/// The first and the last moment that is not a pause, from the first sample of the sound, s.
std::pair<double, double> spoken_range(const speech::Utterance& utterance) {
    double from_s = 0, to_s = utterance.seconds(utterance.samples);
    for (const speech::Phone& phone : utterance.phones)
        if (!phone.is_pause()) {
            from_s = utterance.seconds(std::min(phone.start, phone.closure.value_or(phone.start)));
            break;
        }
    for (auto phone = utterance.phones.rbegin(); phone != utterance.phones.rend(); ++phone)
        if (!phone->is_pause()) {
            to_s = std::max(to_s - 0.5, utterance.seconds(phone->end));
            break;
        }
    return {from_s, to_s};
}

double rounded_up(double s) { return std::ceil(s * 100 - 1e-9) / 100; }

}  // namespace

Json speak_script(const speech::Utterance& utterance, const SpeakScriptOptions& options) {
    const auto [from_s, to_s] = spoken_range(utterance);
    const double start_s = std::max(0.0, rounded_up(speech::kLead_s + kRest_s - from_s));
    const double end_s = rounded_up(start_s + to_s + speech::kTail_s + kRest_s);
    Json event = json_object(
        {{"say", json_object({{"utterance", options.utterance.string()}})}, {"start_s", start_s}});
    const speech::SpeechStyle usual;
    if (options.style.jaw != usual.jaw) event["style"]["jaw"] = options.style.jaw;
    if (options.style.lips != usual.lips) event["style"]["lips"] = options.style.lips;
    if (options.style.anticipation != usual.anticipation)
        event["style"]["anticipation"] = options.style.anticipation;
    if (options.gestures > 0) event["style"]["gestures"] = options.gestures;
    if (options.blinks > 0) event["style"]["blinks"] = options.blinks;
    if (options.gaze > 0) event["style"]["gaze"] = options.gaze;
    for (const speech::ClosureChange& change : options.adjust) {
        Json one = json_object({{"phone", change.phone}});
        const auto put = [&](const char* key, double value) {
            if (value != 0) one[key] = std::round(value * 1e4) / 1e4;
        };
        put("deeper_mm", change.deeper_mm);
        put("earlier_s", change.earlier_s);
        put("shorter_s", change.shorter_s);
        put("wider_mm", change.wider_mm);
        event["adjust"].push_back(std::move(one));
    }
    Json script;
    if (options.base) {
        script = options.base->json();
        if (options.base->has("events")) options.base->at("events").items();
        script["duration_s"] = std::max(end_s, options.base->at("duration_s").number());
    } else {
        script = json_object({{"format", "risorius-script"},
                              {"version", 1},
                              {"fps", options.fps},
                              {"duration_s", end_s}});
    }
    if (!options.base || !options.rig.empty()) script["rig"] = options.rig.string();
    if (!script.contains("events")) script["events"] = Json::array();
    script["events"].push_back(std::move(event));
    return script;
}

}  // namespace risorius::talk
