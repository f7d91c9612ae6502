// SPDX-License-Identifier: MIT
#include "risorius/design/detail/controls.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/known_names.h"
#include "risorius/design/conditions.h"

namespace risorius::design {

const std::vector<std::string>& control_names() {
    static const std::vector<std::string> kNames{
        "reversed",    "scrambled", "apex",    "upside_down", "phase_scrambled", "eyes_only",
        "mouth_only",  "flipped",   "neutral", "knock_out",   "palsy",           "late_side",
        "low_pass",    "high_pass", "oval",    "noise",       "mirrored",        "band_pass",
        "point_light", "mondrian",  "speed",   "chimeric"};
    return kNames;
}

namespace {

const std::vector<std::string>& speed_names() {
    static const std::vector<std::string> kNames{"constant", "accelerated", "decelerated"};
    return kNames;
}

}  // namespace

bool Control::shows_otherwise() const {
    switch (kind) {
        case ControlKind::kReversed:
        case ControlKind::kScrambled:
        case ControlKind::kApex:
        case ControlKind::kUpsideDown:
        case ControlKind::kPhaseScrambled:
        case ControlKind::kEyesOnly:
        case ControlKind::kMouthOnly:
        case ControlKind::kLowPass:
        case ControlKind::kHighPass:
        case ControlKind::kOval:
        case ControlKind::kNoise:
        case ControlKind::kMirrored:
        case ControlKind::kBandPass:
        case ControlKind::kPointLight:
        case ControlKind::kMondrian:
        case ControlKind::kSpeed:
        case ControlKind::kChimeric:
            return true;
        case ControlKind::kNone:
        case ControlKind::kFlipped:
        case ControlKind::kNeutral:
        case ControlKind::kKnockOut:
        case ControlKind::kPalsy:
        case ControlKind::kLateSide:
            return false;
    }
    return false;
}

bool Control::changes_the_oval() const {
    return passes() || kind == ControlKind::kPhaseScrambled || kind == ControlKind::kOval ||
           kind == ControlKind::kNoise || kind == ControlKind::kPointLight ||
           kind == ControlKind::kMondrian;
}

bool Control::passes() const {
    return kind == ControlKind::kLowPass || kind == ControlKind::kHighPass ||
           kind == ControlKind::kBandPass;
}

bool Control::is_random() const {
    return kind == ControlKind::kScrambled || kind == ControlKind::kPhaseScrambled ||
           kind == ControlKind::kNoise || kind == ControlKind::kMondrian ||
           (kind == ControlKind::kPointLight && scattered);
}

Json Control::unnamed() const {
    if (passes()) return json_object({{"order", order}, {"rms", keep_contrast}});
    if (kind == ControlKind::kPointLight) return json_object({{"dots", dots}, {"radius", radius}});
    if (kind == ControlKind::kMondrian) return json_object({{"rate_hz", rate_hz}, {"grey", grey}});
    return {};
}

std::string Control::name() const {
    if (kind == ControlKind::kNone) return {};
    const std::string plain = control_names()[static_cast<std::size_t>(kind) - 1];
    if (kind == ControlKind::kKnockOut) return clip_word("without_" + muscle);
    if (kind == ControlKind::kLowPass || kind == ControlKind::kHighPass)
        return clip_word(plain + "_" + format_number(cycles_per_face));
    if (kind == ControlKind::kBandPass)
        return clip_word(plain + "_" + format_number(cycles_per_face) + "_to_" +
                         format_number(upper_cycles_per_face));
    if (kind == ControlKind::kChimeric) {
        std::string words = plain;
        for (const auto& [name, value] : lower)
            words += "_" + (value.json().is_string() ? value.string() : json_text(value.json()));
        return clip_word(words + (offset != 0 ? "_offset_" + format_number(offset) : ""));
    }
    if (kind == ControlKind::kSpeed)
        return clip_word(speed_names()[static_cast<std::size_t>(speed)] + "_speed");
    if (kind == ControlKind::kPointLight && scattered) return clip_word(plain + "_scattered");
    if (kind == ControlKind::kNoise)
        return clip_word(plain + (snr_db < 0 ? "_m" : "_") + format_number(std::abs(snr_db)));
    if (kind == ControlKind::kPalsy || kind == ControlKind::kLateSide)
        return clip_word(plain + "_" + side);
    return clip_word(plain);
}

namespace {

constexpr int kMaxDots = 93;  // there are so many landmarks on the face

/// One number, or the two ends of a band.
void read_cycles(const JsonCursor& json, Control& control) {
    if (control.kind != ControlKind::kBandPass) {
        control.cycles_per_face = json.number({0.1, 200});
        return;
    }
    if (!json.is_array() || json.items().size() != 2) json.fail("[low, high]");
    control.cycles_per_face = json.items()[0].number({0.1, 200});
    control.upper_cycles_per_face = json.items()[1].number({0.1, 200});
    if (control.upper_cycles_per_face <= control.cycles_per_face)
        json.items()[1].fail("more than the lower end",
                             format_number(control.upper_cycles_per_face));
}

}  // namespace

Control read_control(const JsonCursor& json) {
    Control control;
    const JsonCursor name = json.is_object() ? json.at("control") : json;
    control.kind =
        static_cast<ControlKind>(index_of_name(name.place(), name.string(), control_names()) + 1);
    const bool one_side =
        control.kind == ControlKind::kPalsy || control.kind == ControlKind::kLateSide;
    const bool passes = control.passes();
    if (!json.is_object()) {
        if (passes) json.fail("an object with \"control\" and \"cycles_per_face\"");
        if (control.kind == ControlKind::kNoise)
            json.fail("an object with \"control\" and \"snr_db\"");
        if (control.kind == ControlKind::kKnockOut)
            json.fail("an object with \"control\" and \"muscle\"");
        if (one_side) json.fail("an object with \"control\" and \"side\"");
        if (control.kind == ControlKind::kChimeric)
            json.fail("an object with \"control\" and \"lower\"");
        if (control.kind == ControlKind::kSpeed)
            json.fail("an object with \"control\" and \"profile\"");
        return control;
    }
    std::vector<std::string_view> keys{"control", "when"};
    if (control.kind == ControlKind::kKnockOut) keys.push_back("muscle");
    if (one_side) keys.push_back("side");
    if (control.kind == ControlKind::kSpeed) keys.push_back("profile");
    if (control.kind == ControlKind::kChimeric) keys.insert(keys.end(), {"lower", "offset"});
    if (control.kind == ControlKind::kPalsy) keys.push_back("weakness");
    if (control.kind == ControlKind::kLateSide) keys.push_back("late_s");
    if (passes) keys.insert(keys.end(), {"cycles_per_face", "order", "contrast"});
    if (control.kind == ControlKind::kNoise) keys.push_back("snr_db");
    if (control.kind == ControlKind::kPointLight)
        keys.insert(keys.end(), {"dots", "radius", "scattered"});
    if (control.kind == ControlKind::kMondrian) keys.insert(keys.end(), {"rate_hz", "grey"});
    json.allow_keys(keys);
    if (passes) {
        read_cycles(json.at("cycles_per_face"), control);
        if (const auto v = json.find("order")) control.order = v->integer(1, 16);
        if (const auto v = json.find("contrast"))
            control.keep_contrast = v->one_of({"keep", "rms"}) == "rms";
    }
    if (control.kind == ControlKind::kNoise) control.snr_db = json.at("snr_db").number({-40, 40});
    if (control.kind == ControlKind::kKnockOut) control.muscle = json.at("muscle").string();
    if (control.kind == ControlKind::kSpeed)
        control.speed = static_cast<Speed>(
            index_of_name(json.at("profile").place(), json.at("profile").string(), speed_names()));
    if (one_side) control.side = json.at("side").one_of({"left", "right"});
    if (control.kind == ControlKind::kChimeric) {
        const JsonCursor lower = json.at("lower");
        for (const std::string& key : lower.keys()) control.lower.emplace_back(key, lower.at(key));
        if (control.lower.empty()) lower.fail("at least one parameter of the lower half", "none");
    }
    if (const auto v = json.find("offset")) control.offset = v->number({-1, 1});
    if (const auto v = json.find("dots")) control.dots = v->integer(2, kMaxDots);
    if (const auto v = json.find("radius")) control.radius = v->number({0.001, 0.1});
    if (const auto v = json.find("scattered")) control.scattered = v->boolean();
    if (const auto v = json.find("rate_hz")) control.rate_hz = v->number({0.1, 240});
    if (const auto v = json.find("grey")) control.grey = v->boolean();
    if (const auto v = json.find("weakness")) control.weakness = v->number({0, 1});
    if (const auto v = json.find("late_s")) control.late_s = v->number({0, 10});
    if (const auto when = json.find("when"))
        for (const std::string& key : when->keys()) control.when[key] = when->at(key).json();
    return control;
}

Json controlled(Json script, const Control& control) {
    switch (control.kind) {
        case ControlKind::kNeutral:
            for (const char* key : {"channels", "emg", "events"}) script.erase(key);
            break;
        case ControlKind::kKnockOut:
            script["weakness"][control.muscle] = 1;
            break;
        case ControlKind::kPalsy:
            script["weakness"][control.side] = control.weakness;
            break;
        case ControlKind::kLateSide:
            script["late_s"][control.side] = control.late_s;
            break;
        default:
            break;
    }
    return script;
}

std::vector<int> retimed_order(Speed speed, const std::vector<double>& way, int onset, int apex,
                               int finer, int frames) {
    std::vector<int> order;
    const int last = static_cast<int>(way.size()) - 1;
    const auto at = [&](int frame) { return way[static_cast<std::size_t>(frame)]; };
    for (int i = 0; i < frames; ++i) {
        const int same = std::min(last, finer * i);
        if (same <= onset || same >= apex) {
            order.push_back(same);
            continue;
        }
        const double t = static_cast<double>(same - onset) / (apex - onset);
        const double share = speed == Speed::kConstant      ? t
                             : speed == Speed::kAccelerated ? t * t
                                                            : 1 - (1 - t) * (1 - t);
        const double wanted = at(onset) + share * (at(apex) - at(onset));
        int frame = onset;
        while (frame < apex && at(frame) < wanted) ++frame;
        if (frame > onset && wanted - at(frame - 1) < at(frame) - wanted) --frame;
        order.push_back(frame);
    }
    return order;
}

std::vector<int> frame_order(const Control& control, int frames, int apex, unsigned seed) {
    std::vector<int> order(static_cast<std::size_t>(frames));
    std::iota(order.begin(), order.end(), 0);
    if (control.kind == ControlKind::kReversed) std::reverse(order.begin(), order.end());
    if (control.kind == ControlKind::kApex) std::fill(order.begin(), order.end(), apex);
    if (control.kind == ControlKind::kScrambled) {
        // Fisher-Yates shuffle. The results of std::shuffle differ between standard libraries.
        std::mt19937 random(seed);
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    }
    return order;
}

}  // namespace risorius::design
