// SPDX-License-Identifier: MIT
#include "risorius/speech/windows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace risorius::speech {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Time constants, ms.
struct ClassTimes {
    double jaw, gap, width, protrusion, tip, body;
};

// In the order of PhoneClass.
constexpr ClassTimes kTimes[] = {
    {30, 22, 45, 40, 60, 45},        // vowel
    {30, 22, 55, 60, 60, 45},        // vowel_spread
    {30, 22, 45, 40, 60, 45},        // vowel_round
    {60, 40, 110, 110, 80, 80},      // vowel_weak
    {40, 18, 90, 100, 120, 120},     // closure
    {60, 25, 55, 50, 120, 120},      // labiodental
    {60, 25, 90, 90, 120, 120},      // labiodental_soft
    {35, 29, 90, 150, 30, 50},       // sibilant
    {40, 30, 50, 45, 35, 50},        // sibilant_round
    {45, 35, 45, 45, 50, 45},        // round_cons
    {60, 75, 160, 180, 25, 45},      // tongue
    {38, 45, 160, 180, 25, 45},      // tongue_tip
    {34, 28, 160, 180, 60, 45},      // glide
    {140, 140, 200, 200, 200, 200},  // neutral
    {90, 70, 120, 120, 90, 90},      // silence
};
constexpr double kMs = 1e-3;
/// From here on a phone leaves the parameter to its neighbours.
constexpr double kWeakTau_s = 0.095;

// What the jaw adds to the gap between the lips, mm per mm: at the lips it opens less than at the incisors.
constexpr double kGapOfJaw = 0.9;
// Stressed vowels: Finnish and English, after de Jong 1995, J. Acoust. Soc. Am. 97, 491-504 (more jaw, less reduction).
constexpr double kStressJaw = 1.15, kStressTau = 0.85;

// Windows as fractions of the phone.
constexpr double kVowelFrom = 0.25, kVowelTo = 0.75, kOtherFrom = 0.3, kOtherTo = 0.7;
constexpr double kOpenFrom = 0.30, kOpenTo = 0.75;  // in which a vowel must be open
constexpr double kOpenGap_mm = 1.5, kOpenFraction = 0.3, kAfterLabial_s = 0.040;
// Lips that open late: apart by this from here on; more of it and earlier by these for each second by which the closure is shorter
constexpr double kPartsFrom_s = 0.012, kPartsTo_s = 0.030, kParts_mm = 1;
constexpr double kPartsEarlier = 0.4, kPartsMore_mm_s = 60;
constexpr double kContactLead_s = 0.015;  // labiodentals: the sound begins when the lip is there
constexpr double kContactTo = 0.85;
constexpr double kRelaxingPause_s = 0.15, kRelaxFrom = 0.35, kRelaxTo = 0.65;
constexpr double kRelaxedJaw_mm = 1.5, kRelaxedGap_mm = 1.2;  // of short pauses
constexpr double kStill = 0.02;                    // rest in long pauses, in units of the parameter
constexpr double kSettle_s = 0.2, kWake_s = 0.15;  // of a long pause: closing, opening
// Lips close before the first sound of an utterance.
constexpr double kUnheardClosure_s = 0.080;
// A label of a stop holds its release and breath, too.
constexpr double kReleaseFraction = 0.2, kLongestRelease_s = 0.03;

constexpr double kClosureJaw_mm = 5.5, kLabiodentalJaw_mm = 6, kLabiodentalMore_mm = 2.5,
                 kUpperLipLate_s = 0.01, kSibilantJaw_mm = 3;
constexpr double kSoftContact = 0.6;
// The dorsum touches the palate from the closure of k on, and leaves it at the release; it presses most in between.
constexpr double kTouchingBody = 1.2, kBodyRelease_s = 0.010;
constexpr double kPartedBody = 1.05, kBodyParts_s = 0.025, kBodyApart_s = 0.060;
// The tip is at the ridge from soon after the closure of t on.
constexpr double kTouchingTip = 0.97, kTipTouches_s = 0.005;

double tau_of(PhoneClass kind, Parameter parameter) {
    const ClassTimes& times = kTimes[static_cast<std::size_t>(kind)];
    switch (parameter) {
        case Parameter::kJaw:
            return times.jaw * kMs;
        case Parameter::kGap:
            return times.gap * kMs;
        case Parameter::kWidth:
            return times.width * kMs;
        case Parameter::kProtrusion:
            return times.protrusion * kMs;
        case Parameter::kTipHeight:
        case Parameter::kTipForward:
            return times.tip * kMs;
        default:
            return times.body * kMs;
    }
}

Articulation styled(const PhoneEntry& phone, const SpeechStyle& style, bool stressed) {
    Articulation out = phone.target;
    const double jaw_scale = style.jaw * (stressed ? kStressJaw : 1);
    const double jaw = value_of(phone.target, Parameter::kJaw);
    value_of(out, Parameter::kJaw) = jaw_scale * jaw;
    value_of(out, Parameter::kWidth) *= style.lips;
    value_of(out, Parameter::kProtrusion) *= style.lips;
    double& gap = value_of(out, Parameter::kGap);
    if (gap > 0)
        gap = std::max(0.4, jaw_scale * kGapOfJaw * jaw + style.lips * (gap - kGapOfJaw * jaw));
    return out;
}

class Planner {
  public:
    Planner(const Utterance& utterance, const PhoneTable& table, const SpeechStyle& style)
        : utterance_(utterance), style_(style) {
        for (std::size_t i = 0; i < utterance.phones.size(); ++i)
            entries_.push_back(
                table.phone(utterance.phones[i].symbol, "phone " + std::to_string(i)));
    }

    ArticulationTargets plan() {
        const auto& phones = utterance_.phones;
        // The face moves from before the first sound to after the last one. Pauses at both ends are rest.
        std::size_t first = 0, last = phones.size();
        while (first < last && phones[first].is_pause()) ++first;
        while (last > first && phones[last - 1].is_pause()) --last;
        if (first == last) {
            out_.start_s = 0;
            out_.end_s = utterance_.seconds(utterance_.samples);
            rest(out_.start_s, out_.end_s, -1);
            return std::move(out_);
        }
        find_closures();
        double begin_s = start_of(first);
        if (!out_.closures.empty() && out_.closures[0].first_phone == static_cast<int>(first))
            begin_s = std::min(begin_s, out_.closures[0].closure_s);
        const double end_s = utterance_.seconds(phones[last - 1].end);
        out_.start_s = std::min(0.0, begin_s - 2 * kLead_s);
        out_.end_s = std::max(end_s + 2 * kTail_s, utterance_.seconds(utterance_.samples));
        rest(out_.start_s, begin_s - kLead_s, -1);
        for (std::size_t i = first; i < last; ++i) phone(i);
        rest(end_s + kTail_s, out_.end_s + kCurveMargin_s, -1);
        std::stable_sort(out_.windows.begin(), out_.windows.end(),
                         [](const Window& a, const Window& b) { return a.from_s < b.from_s; });
        return std::move(out_);
    }

  private:
    static constexpr double kCurveMargin_s = 0.01;

    double start_of(std::size_t i) const { return utterance_.seconds(utterance_.phones[i].start); }
    double end_of(std::size_t i) const { return utterance_.seconds(utterance_.phones[i].end); }
    bool is_closure(std::size_t i) const {
        return i < entries_.size() && entries_[i].kind == PhoneClass::kClosure;
    }
    /// The first phone after a pause or at the beginning has no closure that one could hear.
    bool starts_speech(std::size_t i) const {
        return i == 0 || utterance_.phones[i - 1].is_pause();
    }

    double closure_s(std::size_t i) const {
        const Phone& phone = utterance_.phones[i];
        if (phone.closure) return utterance_.seconds(*phone.closure);
        return start_of(i) - (starts_speech(i) ? kUnheardClosure_s : 0);
    }
    double release_s(std::size_t i) const {
        return speech::release_s(utterance_, utterance_.phones[i], entries_[i]);
    }

    void find_closures() {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (!is_closure(i)) continue;
            // Several in a row are one closure (metsan puro: m p).
            if (i > 0 && is_closure(i - 1)) {
                out_.closures.back().last_phone = static_cast<int>(i);
                out_.closures.back().release_s = release_s(i);
            } else {
                out_.closures.push_back(
                    {static_cast<int>(i), static_cast<int>(i), closure_s(i), release_s(i)});
            }
        }
    }

    void window(std::size_t i, Parameter p, double from_s, double to_s, double target,
                double tau_factor) {
        const double tau = tau_of(entries_[i].kind, p) * tau_factor;
        out_.windows.push_back({p, from_s, to_s, target,
                                tau * (entries_[i].weight < 1 ? 1 / entries_[i].weight : 1),
                                tau_of(entries_[i].kind, p) > kWeakTau_s, static_cast<int>(i)});
    }
    void bound(std::size_t i, Parameter p, double from_s, double to_s, double min, double max) {
        out_.bounds.push_back({p, from_s, to_s, min, max, static_cast<int>(i)});
    }

    /// All parameters return to the face at rest.
    void rest(double from_s, double to_s, int phone) {
        if (to_s <= from_s) return;
        for (std::size_t p = 0; p < kParameterCount; ++p) {
            const auto parameter = static_cast<Parameter>(p);
            const double target = parameter == Parameter::kTipHeight    ? 0.2
                                  : parameter >= Parameter::kBodyHeight ? 0.3
                                                                        : 0.0;
            out_.windows.push_back({parameter, from_s, to_s, target,
                                    tau_of(PhoneClass::kSilence, parameter), false, phone});
            if (parameter < Parameter::kTipHeight)
                out_.bounds.push_back(
                    {parameter, from_s, to_s, target - kStill, target + kStill, phone});
        }
    }

    void pause(std::size_t i) {
        const double length_s = end_of(i) - start_of(i);
        if (length_s <= kClosingPause_s) {
            // Too short to close; a mouth that was held open would look frozen.
            if (length_s > kRelaxingPause_s) relax(i, length_s);
            return;
        }
        // A closure after the pause begins before it ends.
        double from_s = start_of(i) + kSettle_s, to_s = end_of(i) - kWake_s;
        if (is_closure(i + 1)) to_s = std::min(to_s, closure_s(i + 1));
        if (to_s <= from_s) {
            const double middle_s = start_of(i) + 0.55 * length_s;
            for (const Parameter p :
                 {Parameter::kJaw, Parameter::kGap, Parameter::kWidth, Parameter::kProtrusion})
                window(i, p, middle_s - 0.02, middle_s + 0.02, 0, 1);
            return;
        }
        rest(from_s, to_s, static_cast<int>(i));
    }

    void relax(std::size_t i, double length_s) {
        const double from_s = start_of(i) + kRelaxFrom * length_s,
                     to_s = start_of(i) + kRelaxTo * length_s;
        window(i, Parameter::kJaw, from_s, to_s, kRelaxedJaw_mm, 1);
        window(i, Parameter::kGap, from_s, to_s, kRelaxedGap_mm, 1);
        for (const Parameter p : {Parameter::kWidth, Parameter::kProtrusion})
            window(i, p, from_s, to_s, 0, 1);
    }

    void phone(std::size_t i) {
        const PhoneEntry& entry = entries_[i];
        if (entry.kind == PhoneClass::kSilence) return pause(i);
        if (entry.kind == PhoneClass::kNeutral) return;  // the shape of what follows
        const bool vowel = is_vowel(entry.kind);
        const bool stressed = vowel && utterance_.phones[i].stress == 2;
        Articulation target = styled(entry, style_, stressed);
        if (entry.closes_palate()) value_of(target, Parameter::kBodyHeight) = kPressedBody;
        const double from_s = start_of(i), length_s = end_of(i) - from_s;
        double a = from_s + (vowel ? kVowelFrom : kOtherFrom) * length_s,
               b = from_s + (vowel ? kVowelTo : kOtherTo) * length_s;
        const double tau_factor = style_.anticipation * (stressed ? kStressTau : 1);
        if (is_closure(i)) {
            const auto closure =
                std::find_if(out_.closures.begin(), out_.closures.end(), [&](const LipClosure& c) {
                    return static_cast<int>(i) >= c.first_phone &&
                           static_cast<int>(i) <= c.last_phone;
                });
            // Phones of a cluster share one window.
            if (closure->first_phone != static_cast<int>(i)) return;
            a = closure->closure_s + kAfterClosure_s;
            b = closure->release_s - kBeforeRelease_s;
            if (b - a < 0.005) {
                const double middle_s = (closure->closure_s + closure->release_s) / 2;
                a = middle_s - 0.0026;
                b = middle_s + 0.0026;
            }
            bound(i, Parameter::kGap, a, b, -kInfinite, kClosedGap_mm);
            bound(i, Parameter::kJaw, a, b, -kInfinite, kClosureJaw_mm);
        }
        for (std::size_t p = 0; p < kParameterCount; ++p) {
            const auto parameter = static_cast<Parameter>(p);
            // What is a hard demand of the lips does not become softer with the style.
            const bool hard = parameter == Parameter::kGap && is_closure(i);
            window(i, parameter, a, b, target[p], hard ? 1 : tau_factor);
        }
        bounds_of(i, target, vowel, from_s, length_s);
    }

    void bounds_of(std::size_t i, const Articulation& target, bool vowel, double from_s,
                   double length_s) {
        const PhoneClass kind = entries_[i].kind;
        if (vowel) {
            double open_s = from_s + kOpenFrom * length_s;
            const double close_s = from_s + kOpenTo * length_s;
            if (i > 0 && is_closure(i - 1))
                open_s = std::max(open_s, release_s(i - 1) + kAfterLabial_s);
            const double gap = value_of(target, Parameter::kGap);
            if (open_s < close_s)
                bound(i, Parameter::kGap, open_s, close_s,
                      std::min(kOpenGap_mm, kOpenFraction * gap), kInfinite);
        }
        if (entries_[i].closes_palate()) {
            bound(i, Parameter::kBodyHeight, closure_s(i),
                  std::max(closure_s(i), release_s(i) - kBodyRelease_s), kTouchingBody, kInfinite);
            // It is away from the palate soon, also before a close vowel.
            if (i + 1 >= entries_.size() || !entries_[i + 1].closes_palate())
                bound(i, Parameter::kBodyHeight, release_s(i) + kBodyParts_s,
                      release_s(i) + kBodyApart_s, -kInfinite, kPartedBody);
        }
        if (entries_[i].closes_ridge()) {
            const double touch_s = closure_s(i) + kTipTouches_s;
            bound(i, Parameter::kTipHeight, touch_s,
                  std::max(touch_s, release_s(i) - kBodyRelease_s), kTouchingTip, kInfinite);
        }
        const double a = from_s - kContactLead_s, b = from_s + kContactTo * length_s;
        if (kind == PhoneClass::kLabiodental || kind == PhoneClass::kLabiodentalSoft) {
            // Bilabial fricatives are of the soft class, too, but have nothing to do with the teeth.
            if (entries_[i].place != "bilabial_cont")
                out_.contacts.push_back({a, b,
                                         kind == PhoneClass::kLabiodental ? 1.0 : kSoftContact,
                                         static_cast<int>(i)});
            bound(i, Parameter::kJaw, a, b, -kInfinite, kLabiodentalJaw_mm);
            // The upper lip stays as low as beside close vowels: lips that open wide around the teeth are a snarl.
            const double most_mm = value_of(target, Parameter::kGap) + kLabiodentalMore_mm;
            bound(i, Parameter::kGap, a + kUpperLipLate_s, b, -kInfinite, most_mm);
        }
        if (kind == PhoneClass::kSibilant || kind == PhoneClass::kSibilantRound)
            bound(i, Parameter::kJaw, from_s + kOtherFrom * length_s, from_s + kOtherTo * length_s,
                  -kInfinite, kSibilantJaw_mm);
    }

    const Utterance& utterance_;
    const SpeechStyle& style_;
    std::vector<PhoneEntry> entries_;
    ArticulationTargets out_;
};

}  // namespace

ArticulationTargets targets_of(const Utterance& utterance, const PhoneTable& table,
                               const SpeechStyle& style) {
    return Planner(utterance, table, style).plan();
}

double release_s(const Utterance& utterance, const Phone& phone, const PhoneEntry& entry) {
    if (phone.release) return utterance.seconds(*phone.release);
    const double end_s = utterance.seconds(phone.end);
    if (!entry.is_stop()) return end_s;
    return end_s -
           std::min(kLongestRelease_s, kReleaseFraction * (end_s - utterance.seconds(phone.start)));
}

std::optional<double> first_burst_s(const Utterance& utterance, const PhoneTable& table) {
    for (const Phone& phone : utterance.phones) {
        const PhoneEntry entry = table.phone(phone.symbol, "phone");
        if (entry.is_stop() || entry.manner == "nasal" || entry.kind == PhoneClass::kClosure)
            return release_s(utterance, phone, entry);
    }
    return std::nullopt;
}

void change_closures(const std::vector<ClosureChange>& changes, ArticulationTargets& targets) {
    for (const ClosureChange& change : changes) {
        if (change.wider_mm > 0)
            for (Window& window : targets.windows)
                if (window.phone == change.phone && window.parameter == Parameter::kGap &&
                    window.target > 0)
                    window.target += change.wider_mm;
        const auto closure =
            std::find_if(targets.closures.begin(), targets.closures.end(),
                         [&](const LipClosure& c) { return c.first_phone == change.phone; });
        if (closure == targets.closures.end()) continue;
        // Lips that open late are apart soon after the release, whatever the next sound asks for.
        if (change.shorter_s > 0)
            targets.bounds.push_back(
                {Parameter::kGap,
                 closure->release_s + kPartsFrom_s - kPartsEarlier * change.shorter_s,
                 closure->release_s + kPartsTo_s, kParts_mm + kPartsMore_mm_s * change.shorter_s,
                 kInfinite, -1});
        const auto move = [&](double& from_s, double& to_s) {
            from_s -= change.earlier_s;
            to_s = std::max(from_s + 0.005, to_s - change.shorter_s);
        };
        for (Window& window : targets.windows) {
            if (window.phone != change.phone) continue;
            move(window.from_s, window.to_s);
            if (window.parameter == Parameter::kGap) window.target -= change.deeper_mm;
        }
        for (Bound& bound : targets.bounds) {
            if (bound.phone != change.phone) continue;
            move(bound.from_s, bound.to_s);
            if (bound.parameter == Parameter::kGap) bound.max -= change.deeper_mm;
        }
    }
}

}  // namespace risorius::speech
