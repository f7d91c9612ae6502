// SPDX-License-Identifier: MIT
#include "risorius/speech/visemes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/json_text.h"
#include "risorius/solve/nonnegative_least_squares.h"

namespace risorius::speech {

namespace {

enum Viseme { kSil, kPP, kFF, kTH, kDD, kKk, kCH, kSS, kNn, kRR, kAa, kE, kIh, kOh, kOu };

// In the order of Parameter: jaw, gap, width, protrusion per mm, tongue tip height and forward, tongue body.
constexpr std::array<double, kParameterCount> kScale{0.5, 1, 0.6, 0.8, 3, 0.15, 1.5, 0.5};
constexpr double kSumScale = 40, kMixtureRidge = 0.02;
/// Cost of a viseme that no phone nearby has, and the time within which one is near.
constexpr double kForeignCost = 4, kNear_s = 0.12;
/// Closures and contacts come and go within this time.
constexpr double kVisemeRamp_s = 0.03;
constexpr int kVisemeRate_hz = 60;
constexpr double kWeightDigits = 1e4, kTimeDigits = 1e3;

/// Of the visemes of the table of phones.
const std::map<std::string, int>& oculus_of_table() {
    static const std::map<std::string, int> kMap{
        {"SIL", kSil}, {"PP", kPP}, {"FF", kFF}, {"VV", kFF}, {"TH", kTH}, {"DD", kDD},
        {"KK", kKk},   {"CH", kCH}, {"SS", kSS}, {"NN", kNn}, {"LL", kNn}, {"RR", kRR},
        {"RT", kRR},   {"YY", kIh}, {"WW", kOu}, {"AA", kAa}, {"AE", kAa}, {"AH", kE},
        {"EH", kE},    {"ER", kE},  {"IH", kIh}, {"IY", kIh}, {"AO", kOh}, {"OW", kOh},
        {"OE", kOh},   {"UH", kOu}, {"UW", kOu}, {"YU", kOu}};
    return kMap;
}

double smooth(double s) { return s * s * (3 - 2 * s); }

/// 1 within an interval, 0 farther than kVisemeRamp_s from it.
double near_interval(double t_s, double from_s, double to_s) {
    const double away = std::max({0.0, from_s - t_s, t_s - to_s}) / kVisemeRamp_s;
    return away >= 1 ? 0 : smooth(1 - away);
}

class Mixer {
  public:
    Mixer(const Utterance& utterance, const ArticulationTargets& targets, const PhoneTable& table)
        : targets_(targets), curves_(curves_of(targets)) {
        for (const Phone& phone : utterance.phones)
            phones_.push_back({table.phone(phone.symbol, "phone"), utterance.seconds(phone.start),
                               utterance.seconds(phone.end)});
        constexpr long kRows = kParameterCount + 1;
        places_.resize(kRows, kVisemeCount);
        for (std::size_t v = 0; v < kVisemeCount; ++v) {
            const std::string name(oculus_visemes()[v]);
            const Articulation place =
                v == kSil
                    ? rest_place()
                    : table.phone(table.split(name, "oculus", "viseme")[0].symbol, "viseme").target;
            for (std::size_t p = 0; p < kParameterCount; ++p)
                places_(static_cast<long>(p), static_cast<long>(v)) = kScale[p] * place[p];
        }
        places_.row(kParameterCount).setConstant(kSumScale);
    }

    Eigen::VectorXd at(double t_s) {
        Eigen::VectorXd y(places_.rows()), cost(places_.cols());
        for (std::size_t p = 0; p < kParameterCount; ++p)
            y[static_cast<long>(p)] =
                kScale[p] * std::min(curves_.at(static_cast<Parameter>(p), t_s), most(p));
        y[kParameterCount] = kSumScale;
        cost.setConstant(kForeignCost);
        // The mouth at rest is always near: sounds reach their place only in part.
        cost[kSil] = kForeignCost / 8;
        for (const TimedPhone& phone : phones_) {
            const double away_s = std::max({0.0, phone.start_s - t_s, t_s - phone.end_s});
            if (away_s >= kNear_s) continue;
            const double here = kForeignCost * smooth(away_s / kNear_s);
            for (const int v : near_visemes(phone.entry)) cost[v] = std::min(cost[v], here);
        }
        Eigen::VectorXd w =
            solve::nonnegative_least_squares(places_, y, cost, kMixtureRidge, state_);
        w /= std::max(w.sum(), 1e-9);
        double closed = 0, contact = 0;
        for (const LipClosure& closure : targets_.closures)
            closed = std::max(closed, near_interval(t_s, closure.closure_s, closure.release_s));
        for (const LabiodentalContact& one : targets_.contacts)
            contact = std::max(contact, one.strength * near_interval(t_s, one.from_s, one.to_s));
        contact *= 1 - closed;
        w *= 1 - closed - contact;
        w[kPP] += closed;
        w[kFF] += contact;
        return w;
    }

  private:
    struct TimedPhone {
        PhoneEntry entry;
        double start_s, end_s;
    };
    /// Visemes do not press on the palate.
    static double most(std::size_t p) {
        return p == static_cast<std::size_t>(Parameter::kBodyHeight) ? 1 : 1e300;
    }
    static Articulation rest_place() {
        Articulation place{};
        value_of(place, Parameter::kTipHeight) = 0.2;
        value_of(place, Parameter::kBodyHeight) = value_of(place, Parameter::kBodyBack) = 0.3;
        return place;
    }
    /// Vowels are mixtures of vowels: y of u and i, ä of a and e.
    static std::vector<int> near_visemes(const PhoneEntry& phone) {
        if (is_vowel(phone.kind)) return {kAa, kE, kIh, kOh, kOu};
        const int one = viseme_of(phone);
        return one < 0 ? std::vector<int>{} : std::vector<int>{one};
    }

    const ArticulationTargets& targets_;
    ArticulationCurves curves_;
    std::vector<TimedPhone> phones_;
    Eigen::MatrixXd places_;  ///< scaled; the last row is for the sum of the weights
    Eigen::VectorXd state_;
};

double milliseconds(const Utterance& utterance, std::int64_t samples) {
    return std::round(1e3 * utterance.seconds(samples) * kTimeDigits) / kTimeDigits;
}

}  // namespace

const std::array<std::string_view, kVisemeCount>& oculus_visemes() {
    static constexpr std::array<std::string_view, kVisemeCount> kNames{
        "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"};
    return kNames;
}

int viseme_of(const PhoneEntry& phone) {
    if (phone.kind == PhoneClass::kNeutral) return -1;
    const auto found = oculus_of_table().find(phone.viseme);
    return found == oculus_of_table().end() ? kSil : found->second;
}

std::vector<TimedViseme> visemes_of(const Utterance& utterance, const PhoneTable& table) {
    const std::vector<LipClosure> closures = targets_of(utterance, table).closures;
    const auto sample = [&](double t_s) {
        return std::clamp<std::int64_t>(std::llround(t_s * utterance.rate_hz), 0,
                                        utterance.samples);
    };
    std::vector<TimedViseme> out;
    const auto add = [&](int viseme, std::int64_t start, std::int64_t end) {
        if (!out.empty()) start = std::max(start, out.back().end);
        if (end <= start) return;
        if (!out.empty() && out.back().viseme == viseme && out.back().end == start)
            out.back().end = end;
        else
            out.push_back({viseme, start, end});
    };
    std::int64_t waiting = -1;  // start of an h, which has the shape of what follows
    for (std::size_t i = 0; i < utterance.phones.size(); ++i) {
        const Phone& phone = utterance.phones[i];
        const int viseme = phone.is_pause() ? kSil : viseme_of(table.phone(phone.symbol, "phone"));
        if (viseme < 0) {
            if (waiting < 0) waiting = phone.start;
            continue;
        }
        const std::int64_t start = std::exchange(waiting, -1);
        if (phone.is_pause()) continue;
        const auto closure =
            std::find_if(closures.begin(), closures.end(), [&](const LipClosure& one) {
                return static_cast<int>(i) >= one.first_phone &&
                       static_cast<int>(i) <= one.last_phone;
            });
        if (closure == closures.end())
            add(viseme, start < 0 ? phone.start : start, phone.end);
        else if (closure->first_phone == static_cast<int>(i))
            add(viseme, sample(closure->closure_s), sample(closure->release_s));
    }
    return out;
}

Eigen::MatrixXd viseme_weights(const Utterance& utterance, const ArticulationTargets& targets,
                               const PhoneTable& table, double from_s, double rate_hz, long count) {
    Mixer mixer(utterance, targets, table);
    Eigen::MatrixXd out(count, static_cast<long>(kVisemeCount));
    for (long k = 0; k < count; ++k)
        out.row(k) = mixer.at(from_s + static_cast<double>(k) / rate_hz).transpose();
    return out;
}

std::string visemes_text(const Utterance& utterance, const PhoneTable& table) {
    // TalkingHead's rigs have other names for the vowels than Oculus.
    static constexpr std::array<std::string_view, 3> kVowels{"I", "O", "U"};
    const auto name = [](std::size_t v) {
        return std::string(v < kIh ? oculus_visemes()[v] : kVowels[v - kIh]);
    };
    Json visemes = Json::array(), times = Json::array(), lengths = Json::array();
    for (const TimedViseme& one : visemes_of(utterance, table)) {
        visemes.push_back(name(static_cast<std::size_t>(one.viseme)));
        times.push_back(milliseconds(utterance, one.start));
        lengths.push_back(milliseconds(utterance, one.end - one.start));
    }
    Json words = Json::array(), word_times = Json::array(), word_lengths = Json::array();
    for (const Span& word : utterance.words) {
        words.push_back(word.text);
        word_times.push_back(milliseconds(utterance, word.start));
        word_lengths.push_back(milliseconds(utterance, word.end - word.start));
    }
    // A frame after the sound's end, and the face at rest after it.
    const double step_s = 1.0 / kVisemeRate_hz;
    const long count = static_cast<long>(
        std::ceil((utterance.seconds(utterance.samples) + kTail_s + kVisemeRamp_s) / step_s));
    const Eigen::MatrixXd weights = viseme_weights(utterance, targets_of(utterance, table), table,
                                                   step_s, kVisemeRate_hz, count);
    Json steps = Json::array(), values = Json::object();
    for (long k = 1; k <= count; ++k) {
        // Whole microseconds, such that their sum does not drift.
        const auto time_us = [&](long i) {
            return std::round(1e6 * static_cast<double>(i) * step_s);
        };
        steps.push_back((time_us(k) - time_us(k - 1)) / 1e3);
    }
    for (std::size_t v = 0; v < kVisemeCount; ++v) {
        Json column = Json::array();
        for (long k = 0; k < count; ++k)
            column.push_back(std::round(weights(k, static_cast<long>(v)) * kWeightDigits) /
                             kWeightDigits);
        values["viseme_" + name(v)] = std::move(column);
    }
    Json out{{"format", "risorius-visemes"}, {"version", 1}};
    if (!utterance.sound.empty()) out["sound"] = utterance.sound.generic_string();
    if (!utterance.language.empty()) out["language"] = utterance.language;
    out["duration_ms"] = milliseconds(utterance, utterance.samples);
    out["visemes"] = std::move(visemes);
    out["vtimes"] = std::move(times);
    out["vdurations"] = std::move(lengths);
    out["words"] = std::move(words);
    out["wtimes"] = std::move(word_times);
    out["wdurations"] = std::move(word_lengths);
    out["weights"] = {{"name", "visemes"}, {"dt", std::move(steps)}, {"vs", std::move(values)}};
    return json_text(out) + "\n";
}

}  // namespace risorius::speech
