// SPDX-License-Identifier: MIT
#include "risorius/speech/landmarks.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace risorius::speech {

namespace {

constexpr double kFrame_s = 0.005, kHop_s = 0.001;
// Lips close before the first sound; a silence before it does not tell when.
constexpr double kFirstClosure_s = 0.080;
constexpr double kLongestClosure_s = 0.4;
// A burst may begin a little before its event.
constexpr double kEventSlack_s = 0.008;
constexpr double kReleaseSearch_s = 0.060;
constexpr double kDoubledSearch_s = 0.100;
constexpr double kShortestPhone_s = 0.005;

/// Levels of the sound in frames of 5 ms, one each millisecond.
class Levels {
  public:
    Levels(std::span<const float> sound, int rate_hz) : rate_hz_(rate_hz) {
        const auto hop = std::max<std::size_t>(1, static_cast<std::size_t>(kHop_s * rate_hz));
        const auto frame = std::max<std::size_t>(1, static_cast<std::size_t>(kFrame_s * rate_hz));
        hop_ = hop;
        for (std::size_t at = 0; at < sound.size(); at += hop) {
            // Centred at its time
            const std::size_t from = at > frame / 2 ? at - frame / 2 : 0,
                              to = std::min(sound.size(), at + frame - frame / 2);
            double all = 0, high = 0;
            for (std::size_t i = from; i < to; ++i) {
                const double x = sound[i];
                all += x * x;
                // Two differences: rises by 12 dB an octave, so that what is above 3 kHz counts.
                if (i < 2) continue;
                const double d = x - 2.0 * sound[i - 1] + sound[i - 2];
                high += d * d;
            }
            const double count = std::max<std::size_t>(1, to - from);
            all_db_.push_back(10 * std::log10(all / count + 1e-12));
            high_db_.push_back(10 * std::log10(high / count + 1e-12));
        }
        loudest_db_ = all_db_.empty() ? 0 : *std::max_element(all_db_.begin(), all_db_.end());
    }

    std::int64_t hop() const { return static_cast<std::int64_t>(hop_); }
    bool is_silent(std::int64_t sample) const {
        return level(all_db_, sample) < loudest_db_ - kSilence_db;
    }
    double high_db(std::int64_t sample) const { return level(high_db_, sample); }
    double all_db(std::int64_t sample) const { return level(all_db_, sample); }
    std::int64_t samples(double s) const { return std::llround(s * rate_hz_); }

  private:
    double level(const std::vector<double>& levels, std::int64_t sample) const {
        const std::int64_t i = sample / hop();
        if (sample < 0 || i >= static_cast<std::int64_t>(levels.size())) return -120;
        return levels[static_cast<std::size_t>(i)];
    }
    int rate_hz_;
    std::size_t hop_ = 1;
    std::vector<double> all_db_, high_db_;
    double loudest_db_ = 0;
};

class Finder {
  public:
    Finder(Utterance& utterance, std::span<const float> sound, const PhoneTable& table)
        : utterance_(utterance), levels_(sound, utterance.rate_hz) {
        for (std::size_t i = 0; i < utterance.phones.size(); ++i)
            entries_.push_back(
                table.phone(utterance.phones[i].symbol, "phone " + std::to_string(i)));
    }

    void at_bursts() {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (entries_[i].is_stop() && !entries_[i].voiced)
                voiceless_at_burst(i);
            else if (has_closure(i))
                at_closure(i, /*hidden=*/true);
        }
        move_doubled();
        onsets();
    }

    void at_closures() {
        for (std::size_t i = 0; i < entries_.size(); ++i)
            if (has_closure(i)) at_closure(i, false);
        onsets();
    }

  private:
    Phone& phone(std::size_t i) { return utterance_.phones[i]; }
    bool has_closure(std::size_t i) const {
        return entries_[i].manner == "stop" || entries_[i].manner == "nasal";
    }
    bool starts_speech(std::size_t i) { return i == 0 || phone(i - 1).is_pause(); }

    /// The phone begins earlier, at the cost of the one before.
    void begin_at(std::size_t i, std::int64_t start) {
        if (i > 0) {
            start = std::max(start, phone(i - 1).start + levels_.samples(kShortestPhone_s));
            if (start >= phone(i).end) return;
            phone(i - 1).end = start;
            // What ended in the part that is lost
            if (phone(i - 1).release && *phone(i - 1).release > start) phone(i - 1).release = start;
        }
        phone(i).start = start;
    }

    void voiceless_at_burst(std::size_t i) {
        const std::int64_t event = phone(i).start;
        // From a little before the event back over the silence
        std::int64_t at = event - levels_.samples(kEventSlack_s) / 2;
        const std::int64_t limit = event - levels_.samples(kLongestClosure_s);
        std::int64_t silent = at;
        while (silent > limit && silent > event - levels_.samples(2 * kEventSlack_s) &&
               !levels_.is_silent(silent))
            silent -= levels_.hop();
        phone(i).release = event;
        if (starts_speech(i)) {
            // Silence goes on and on: nobody hears when the lips close.
            phone(i).closure = event - levels_.samples(kFirstClosure_s);
            if (i > 0) begin_at(i, std::max(*phone(i).closure, phone(i - 1).start));
            return;
        }
        if (levels_.is_silent(silent)) {
            at = silent;
            while (at > limit && levels_.is_silent(at - levels_.hop())) at -= levels_.hop();
        }
        at = std::max(at, phone(i - 1).start + levels_.samples(kShortestPhone_s));
        begin_at(i, std::min(at, event));
        phone(i).closure = phone(i).start;
        if (*phone(i).closure >= event) phone(i).closure = event - levels_.hop();
    }

    void at_closure(std::size_t i, bool hidden) {
        std::int64_t start = phone(i).start;
        // espeak-ng: the closure of a voiced stop that begins a word is between the event of the word and its own.
        if (hidden && entries_[i].is_stop() && !starts_speech(i))
            if (const int word = utterance_.word_at(start); word >= 0) {
                const std::int64_t begins = utterance_.words[static_cast<std::size_t>(word)].start;
                if (begins < start && begins > phone(i - 1).start &&
                    start - begins < levels_.samples(kFirstClosure_s)) {
                    begin_at(i, begins);
                    start = phone(i).start;
                }
            }
        phone(i).closure = start;
        if (starts_speech(i)) phone(i).closure = start - levels_.samples(kFirstClosure_s) / 2;
        if (!entries_[i].is_stop()) {
            phone(i).release = phone(i).end;
            return;
        }
        phone(i).release = hidden ? phone(i).end : burst_in(i);
        if (*phone(i).release <= *phone(i).closure) phone(i).release = phone(i).end;
    }

    /// The steepest rise of the high frequencies near the end of a stop.
    std::int64_t burst_in(std::size_t i) {
        const std::int64_t from =
            std::max(phone(i).start + levels_.hop(),
                     phone(i).end - std::max(levels_.samples(kReleaseSearch_s),
                                             2 * (phone(i).end - phone(i).start) / 3));
        std::int64_t best = phone(i).end;
        double steepest = 0;
        const std::int64_t reach = levels_.samples(kFrame_s) / 2 + levels_.hop();
        for (std::int64_t at = from; at <= phone(i).end; at += levels_.hop()) {
            const double rise = levels_.high_db(at + reach) - levels_.high_db(at - reach);
            if (rise <= steepest) continue;
            steepest = rise;
            best = at;
        }
        return best;
    }

    /// espeak-ng marks doubled l, r, m and n up to 90 ms late: the sound changes before.
    void move_doubled() {
        for (std::size_t i = 1; i < entries_.size(); ++i) {
            const std::string& manner = entries_[i].manner;
            if (phone(i).length_mark != 2 ||
                (manner != "nasal" && manner != "lat" && manner != "trill"))
                continue;
            const std::int64_t event = phone(i).start;
            std::int64_t best = event;
            double largest = 3;  // dB: smaller changes are none
            const std::int64_t reach = levels_.samples(2 * kFrame_s);
            const std::int64_t from =
                std::max(event - levels_.samples(kDoubledSearch_s),
                         phone(i - 1).start + levels_.samples(8 * kShortestPhone_s));
            for (std::int64_t at = from; at <= event; at += levels_.hop()) {
                const double change =
                    std::abs(levels_.all_db(at + reach) - levels_.all_db(at - reach)) +
                    std::abs(levels_.high_db(at + reach) - levels_.high_db(at - reach));
                if (change <= largest) continue;
                largest = change;
                best = at;
            }
            begin_at(i, best);
            if (phone(i).closure) phone(i).closure = phone(i).start;
        }
    }

    /// The voice begins with the first voiced sound after a voiceless stop.
    void onsets() {
        for (std::size_t i = 0; i + 1 < entries_.size(); ++i)
            if (entries_[i].is_stop() && !entries_[i].voiced && entries_[i + 1].voiced)
                phone(i).voice_onset = phone(i).end;
    }

    Utterance& utterance_;
    std::vector<PhoneEntry> entries_;
    Levels levels_;
};

}  // namespace

void find_landmarks(Utterance& utterance, std::span<const float> sound, const PhoneTable& table,
                    StopMark mark) {
    Finder finder(utterance, sound, table);
    if (mark == StopMark::kBurst)
        finder.at_bursts();
    else
        finder.at_closures();
}

}  // namespace risorius::speech
