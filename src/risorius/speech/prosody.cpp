// SPDX-License-Identifier: MIT
#include "risorius/speech/prosody.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/counter_rng.h"

namespace risorius::speech {

namespace {

constexpr double kBrowLead_s = 0.10, kBrowTail_s = 0.30, kBrow = 0.35;
constexpr double kNodRise_s = 0.12, kNodFall_s = 0.35, kNod_deg = 3, kSmallNod_deg = 1;
constexpr double kEnd_deg = 1.5, kEndFall_s = 0.7;
constexpr double kQuestionBrow = 0.45;
constexpr double kBlinksPerMinute = 26, kBlink_s = 0.22, kBlinkApart_s = 0.8;
constexpr double kFromBurst_s = 0.10, kNearPause_s = 0.15;
/// Words of fewer phones are articles and the like.
constexpr int kContentPhones = 4;

double minimum_jerk(double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * s * (10 + s * (6 * s - 15));
}

/// A stressed vowel with its word.
struct Stress {
    double word_s, vowel_s, vowel_end_s;
    int phones;  ///< of the word
};

/// Words from which a sentence consists, by their indices, and its end.
struct Sentence {
    double start_s, end_s;
    bool question;
};

std::vector<Sentence> sentences_of(const Utterance& u) {
    std::vector<Sentence> out;
    const auto add = [&](double start_s, double end_s, const std::string& text) {
        out.push_back({start_s, end_s, text.find('?') != std::string::npos});
    };
    for (const Span& span : u.sentences) add(u.seconds(span.start), u.seconds(span.end), span.text);
    if (out.empty()) add(0, u.seconds(u.samples), "");
    return out;
}

std::vector<Stress> stresses_of(const Utterance& u, const PhoneTable& table) {
    std::vector<Stress> out;
    std::vector<int> counts(u.words.size(), 0);
    const auto word_of = [&](const Phone& phone) {
        return u.word_at((phone.start + phone.end) / 2);
    };
    for (const Phone& phone : u.phones)
        if (const int word = word_of(phone); word >= 0) ++counts[static_cast<std::size_t>(word)];
    for (const Phone& phone : u.phones) {
        const int word = word_of(phone);
        if (phone.stress < 2 || word < 0 || !is_vowel(table.phone(phone.symbol, "phone").kind))
            continue;
        const auto w = static_cast<std::size_t>(word);
        out.push_back(
            {u.seconds(u.words[w].start), u.seconds(phone.start), u.seconds(phone.end), counts[w]});
    }
    return out;
}

void add_gestures(const Utterance& u, const PhoneTable& table, double size, Prosody& out) {
    const std::vector<Stress> stresses = stresses_of(u, table);
    for (const Sentence& sentence : sentences_of(u)) {
        std::vector<Stress> own;
        for (const Stress& stress : stresses)
            if (stress.vowel_s >= sentence.start_s && stress.vowel_s < sentence.end_s &&
                stress.phones >= kContentPhones)
                own.push_back(stress);
        if (own.empty()) continue;
        // The first stress raises the brows; the last one is the heaviest; others are small nods.
        const auto brow = [&](const Stress& stress, double amount) {
            out.gestures.push_back({Gesture::Kind::kBrow, stress.word_s - kBrowLead_s,
                                    (stress.vowel_s + stress.vowel_end_s) / 2,
                                    stress.vowel_end_s + kBrowTail_s, amount * size});
        };
        const auto nod = [&](const Stress& stress, double degrees) {
            const double peak_s = stress.vowel_s + kNodRise_s;
            out.gestures.push_back(
                {Gesture::Kind::kNod, stress.vowel_s, peak_s, peak_s + kNodFall_s, degrees * size});
        };
        brow(own.front(), kBrow);
        for (std::size_t i = 0; i < own.size(); ++i)
            nod(own[i], i + 1 == own.size() && !sentence.question ? kNod_deg : kSmallNod_deg);
        if (sentence.question) {
            brow(own.back(), kQuestionBrow);
        } else {
            const Stress& last = own.back();
            out.gestures.push_back(
                {Gesture::Kind::kNod, last.vowel_end_s,
                 std::max(sentence.end_s, last.vowel_end_s + kNodRise_s),
                 std::max(sentence.end_s, last.vowel_end_s + kNodRise_s) + kEndFall_s,
                 kEnd_deg * size});
        }
    }
}

void add_blinks(const Utterance& u, const ProsodyOptions& options, Prosody& out) {
    std::vector<double> bursts;
    std::vector<double> pauses;
    for (const Phone& phone : u.phones) {
        if (phone.release && !phone.is_pause()) bursts.push_back(u.seconds(*phone.release));
        if (phone.is_pause()) pauses.push_back(u.seconds(phone.start));
    }
    for (const Span& span : u.sentences) pauses.push_back(u.seconds(span.end));
    const double length_s = u.seconds(u.samples);
    const int wanted =
        static_cast<int>(std::lround(options.blinks * kBlinksPerMinute * length_s / 60));
    const auto is_free = [&](double t_s) {
        return std::none_of(bursts.begin(), bursts.end(),
                            [&](double burst_s) {
                                return burst_s > t_s - kFromBurst_s &&
                                       burst_s < t_s + kBlink_s + kFromBurst_s;
                            }) &&
               std::none_of(out.blinks_s.begin(), out.blinks_s.end(), [&](double other_s) {
                   return std::abs(other_s - t_s) < kBlinkApart_s;
               });
    };
    // 60 % of the blinks are near pauses. A few tries find a free place for each.
    for (int i = 0; i < wanted; ++i)
        for (std::uint64_t chance = 0; chance < 20; ++chance) {
            CounterRng rng = CounterRng(options.seed).at(static_cast<std::uint64_t>(i)).at(chance);
            const double kind = rng.at(0).uniform(), place = rng.at(1).uniform();
            double t_s = place * length_s;
            if (kind < 0.6 && !pauses.empty()) {
                const auto p =
                    std::min(pauses.size() - 1,
                             static_cast<std::size_t>(place * static_cast<double>(pauses.size())));
                t_s = pauses[p] + (2 * rng.at(2).uniform() - 1) * kNearPause_s;
            }
            if (t_s < 0 || !is_free(t_s)) continue;
            out.blinks_s.push_back(t_s);
            break;
        }
    std::sort(out.blinks_s.begin(), out.blinks_s.end());
}

}  // namespace

double Gesture::at(double t_s) const {
    if (t_s <= start_s || t_s >= end_s) return 0;
    if (t_s < peak_s) return size * minimum_jerk((t_s - start_s) / (peak_s - start_s));
    return size * (1 - minimum_jerk((t_s - peak_s) / (end_s - peak_s)));
}

Prosody prosody_of(const Utterance& utterance, const PhoneTable& table,
                   const ProsodyOptions& options) {
    Prosody out;
    if (options.gestures > 0) add_gestures(utterance, table, options.gestures, out);
    if (options.blinks > 0) add_blinks(utterance, options, out);
    out.gaze = gaze_of(utterance, options.gaze, options.seed);
    return out;
}

}  // namespace risorius::speech
