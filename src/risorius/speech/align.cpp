// SPDX-License-Identifier: MIT
#include "risorius/speech/align.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "risorius/core/error.h"
#include "risorius/speech/detail/align/boundary_move.h"
#include "risorius/speech/detail/align/mel_cepstra.h"
#include "risorius/speech/detail/align/time_warp.h"
#include "risorius/speech/landmarks.h"

namespace risorius::speech {

namespace {

constexpr double kShortestRecording_s = 0.1;
// Level of the loudest 25 ms below which nobody speaks, and the least distance from the softest to the loudest part
constexpr double kSoftest_db = -65;
// Only silences of this length are waited in.
constexpr double kWait_s = 0.06;
constexpr double kLongestRatio = 3;
// A recording that fits the text as badly as this is one of something else. Measured with three languages: the right text 0.69 to
// 0.85, another text or language 0.93 to 1.08
constexpr double kWorstMisfit = 0.90;
constexpr double kShortestAligned_s = 0.010;

std::string number_text(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

void check_sound(const SoundView& sound, const std::string& place) {
    const double length_s = static_cast<double>(sound.samples.size()) / sound.rate_hz;
    if (length_s < kShortestRecording_s || length_s > kLongestRecording_s)
        throw Error(place,
                    "a recording of " + format_number(kShortestRecording_s) + " to " +
                        format_number(kLongestRecording_s) + " s",
                    number_text(length_s, 3) + " s");
}

SoundFrames checked_frames(const SoundView& sound, double top_hz, const std::string& place) {
    check_sound(sound, place);
    SoundFrames out = frames_of(sound.samples, sound.rate_hz, top_hz);
    if (out.loudest_db < kSoftest_db)
        throw Error(place, "a recording of speech",
                    "silence: its loudest part is at " + number_text(out.loudest_db, 0) +
                        " dB of full scale");
    return out;
}

/// The phones of a voice that are not pauses, in frames.
struct Model {
    Features features;
    std::vector<std::size_t> phones;  ///< index of each in the utterance
    std::vector<long> begins;         ///< its first frame
    std::vector<bool> begins_word;
};

/// Keeps the frames of the phones in an order.
Model model_of(const SoundFrames& frames, const Utterance& said,
               const std::vector<std::size_t>& order) {
    Model out;
    std::vector<long> kept;
    for (const std::size_t k : order) {
        const Phone& phone = said.phones[k];
        const auto edge = [&](std::int64_t sample) {
            return std::clamp(std::lround(said.seconds(sample) / kCepstraHop_s), 0L,
                              frames.count() - 1);
        };
        const long from = edge(phone.start), to = std::max(from + 1, edge(phone.end));
        out.phones.push_back(k);
        out.begins.push_back(static_cast<long>(kept.size()));
        const bool first = k == 0 || said.phones[k - 1].is_pause();
        bool word = first;
        for (const Span& span : said.words)
            word = word || (span.start >= phone.start && span.start < phone.end);
        out.begins_word.push_back(word);
        for (long i = from; i < to; ++i) kept.push_back(std::min(i, frames.count() - 1));
    }
    out.features.resize(frames.features.rows(), static_cast<long>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i)
        out.features.col(static_cast<long>(i)) = frames.features.col(kept[i]);
    return out;
}

/// Silences of at least kWait_s.
std::vector<bool> long_silences(const std::vector<bool>& silent) {
    std::vector<bool> out(silent.size(), false);
    const auto least = static_cast<std::size_t>(kWait_s / kCepstraHop_s);
    for (std::size_t i = 0; i < silent.size();) {
        std::size_t end = i;
        while (end < silent.size() && silent[end] == silent[i]) ++end;
        if (silent[i] && (end - i >= least || i == 0 || end == silent.size()))
            std::fill(out.begin() + static_cast<long>(i), out.begin() + static_cast<long>(end),
                      true);
        i = end;
    }
    return out;
}

/// Moves borders between voiced sounds that flow into each other to where people hear them.
Utterance without_lateness(const SaidByVoice& voice, const PhoneTable& table) {
    Utterance out = voice.utterance;
    const auto flows = [&](const Phone& phone) {
        const PhoneEntry entry = table.phone(phone.symbol, "voice");
        return entry.voiced && !entry.is_stop() && entry.manner != "fric";
    };
    const std::int64_t late = std::llround(voice.late_s * out.rate_hz);
    for (std::size_t k = 1; k < out.phones.size(); ++k) {
        Phone &before = out.phones[k - 1], &phone = out.phones[k];
        if (!flows(before) || !flows(phone)) continue;
        // The phone before keeps half of its time.
        const std::int64_t moved = phone.start - std::min(late, (before.end - before.start) / 2);
        for (Span& word : out.words) {
            if (word.start == phone.start) word.start = moved;
            if (word.end == phone.start) word.end = moved;
        }
        before.end = phone.start = moved;
    }
    return out;
}

class Aligner {
  public:
    Aligner(const SoundView& recording, const SaidByVoice& voice, const PhoneTable& table,
            const std::string& place)
        : recording_(recording),
          said_(without_lateness(voice, table)),
          table_(table),
          place_(place) {
        const double top_hz = top_of_bands_hz(recording.rate_hz, voice.sound.rate_hz);
        frames_ = checked_frames(recording, top_hz, place);
        voice_frames_ = frames_of(voice.sound.samples, voice.sound.rate_hz, top_hz);
        silent_ = long_silences(frames_.silent);
        for (std::size_t k = 0; k < said_.phones.size(); ++k)
            if (!said_.phones[k].is_pause()) order_.push_back(k);
    }

    Alignment align() {
        check_length();
        const Model model = model_of(voice_frames_, said_, order_);
        const WarpPath path = warp_model(model);
        Alignment out;
        std::vector<std::size_t> backwards(order_.rbegin(), order_.rend());
        out.misfit = path.cost / warp_model(model_of(voice_frames_, said_, backwards)).cost;
        if (!(out.misfit < kWorstMisfit))
            throw Error(place_,
                        "a recording of this text" +
                            (said_.language.empty() ? "" : " in " + said_.language),
                        "one that fits as badly as these sounds in another order (" +
                            number_text(out.misfit, 2) + ")");
        Utterance& utterance = out.utterance;
        utterance.rate_hz = recording_.rate_hz;
        utterance.samples = static_cast<std::int64_t>(recording_.samples.size());
        utterance.language = said_.language;
        utterance.source = said_.source;
        utterance.source.program = "risorius align, voice " + said_.source.program;
        add_phones(model, path, utterance);
        move_borders(utterance.phones, table_, recording_.samples, recording_.rate_hz);
        place_spans(utterance);
        word_fits(model, path, out);
        for (std::size_t i = 1; i + 1 < utterance.phones.size(); ++i)
            out.pauses += utterance.phones[i].is_pause();
        find_landmarks(utterance, recording_.samples, table_, StopMark::kClosure);
        check_utterance(utterance, table_, place_);
        return out;
    }

  private:
    void check_length() const {
        std::int64_t spoken = 0;
        for (const std::size_t k : order_) spoken += said_.phones[k].end - said_.phones[k].start;
        const double usual_s = said_.seconds(spoken), found_s = frames_.spoken_s();
        if (found_s < usual_s / kLongestRatio || found_s > usual_s * kLongestRatio)
            throw Error(place_,
                        number_text(usual_s / kLongestRatio, 2) + " to " +
                            number_text(usual_s * kLongestRatio, 2) + " s of speech for this text",
                        number_text(found_s, 2) + " s");
    }

    WarpPath warp_model(const Model& model) const {
        WarpInput input{
            &model.features, &frames_.features,
            std::vector<bool>(static_cast<std::size_t>(model.features.cols()) + 1, false), silent_};
        for (std::size_t p = 0; p < model.phones.size(); ++p)
            if (model.begins_word[p] ||
                table_.phone(said_.phones[model.phones[p]].symbol, place_).is_stop())
                input.may_wait[static_cast<std::size_t>(model.begins[p])] = true;
        input.may_wait.front() = input.may_wait.back() = true;
        return warp(input);
    }

    std::int64_t sample_at(double frame) const {
        return std::clamp<std::int64_t>(std::llround(frame * kCepstraHop_s * recording_.rate_hz), 0,
                                        static_cast<std::int64_t>(recording_.samples.size()));
    }

    void add_pause(Utterance& utterance, std::int64_t end) const {
        const std::int64_t start = utterance.phones.empty() ? 0 : utterance.phones.back().end;
        if (end - start < std::llround(kShortestAligned_s * utterance.rate_hz)) return;
        Phone pause;
        pause.symbol = kPause;
        pause.start = start;
        pause.end = end;
        utterance.phones.push_back(std::move(pause));
    }

    void add_phones(const Model& model, const WarpPath& path, Utterance& utterance) {
        const std::int64_t shortest = std::llround(kShortestAligned_s * utterance.rate_hz);
        for (std::size_t p = 0; p < model.phones.size(); ++p) {
            const auto i = static_cast<std::size_t>(model.begins[p]);
            const long waited = path.waits[i];
            // A word may wait; within a word, silence belongs to the closure of a stop.
            const bool pause = p == 0 || (waited > 0 && model.begins_word[p]);
            const double ends = p == 0 ? 0 : static_cast<double>(path.last[i - 1]) + 0.5;
            const double begins = static_cast<double>(path.first[i]) - 0.5;
            const double border =
                p == 0
                    ? begins
                    : (static_cast<double>(path.last[i - 1]) + static_cast<double>(path.first[i])) /
                          2;
            std::int64_t start = sample_at(pause ? begins : waited > 0 ? ends : border);
            if (p > 0) {
                Phone& before = utterance.phones.back();
                before.end = std::max(before.start + shortest, sample_at(pause ? ends : border));
                if (waited > 0 && !pause) before.end = std::max(before.start + shortest, start);
                start = std::max(start, before.end);
            }
            if (pause) add_pause(utterance, start);
            Phone phone = said_.phones[model.phones[p]];
            phone.closure = phone.release = phone.voice_onset = std::nullopt;
            if (!utterance.phones.empty()) {
                if (utterance.phones.back().end < start) utterance.phones.back().end = start;
                start = utterance.phones.back().end;
            }
            phone.start = start;
            phone.end = start + shortest;
            place_of_[model.phones[p]] = utterance.phones.size();
            utterance.phones.push_back(std::move(phone));
        }
        // The last one ends where the recording begins to wait for its end.
        Phone& last = utterance.phones.back();
        last.end = std::max(last.end, sample_at(static_cast<double>(path.last.back()) + 0.5));
        add_pause(utterance, utterance.samples);
        utterance.phones.back().end = utterance.samples;
        // A recording that is too short for all of its phones at its end
        for (std::size_t k = utterance.phones.size(); k-- > 0;) {
            Phone& phone = utterance.phones[k];
            const std::int64_t limit =
                k + 1 < utterance.phones.size() ? utterance.phones[k + 1].start : utterance.samples;
            phone.end = std::min(phone.end, limit);
            phone.start = std::min(phone.start, phone.end - 1);
        }
    }

    /// Words and sentences begin and end with their phones.
    void place_spans(Utterance& utterance) const {
        const auto place = [&](const std::vector<Span>& from, std::vector<Span>& to) {
            for (const Span& span : from) {
                Span out{span.text, -1, -1};
                for (const std::size_t k : order_) {
                    const std::int64_t middle = (said_.phones[k].start + said_.phones[k].end) / 2;
                    if (middle < span.start || middle >= span.end) continue;
                    const Phone& phone = utterance.phones[place_of_.at(k)];
                    if (out.start < 0) out.start = phone.start;
                    out.end = phone.end;
                }
                if (out.start >= 0) to.push_back(out);
            }
        };
        place(said_.words, utterance.words);
        place(said_.sentences, utterance.sentences);
    }

    void word_fits(const Model& model, const WarpPath& path, Alignment& out) const {
        std::vector<double> means;
        for (const Span& span : out.utterance.words) {
            double sum = 0;
            long count = 0;
            for (std::size_t p = 0; p < model.phones.size(); ++p) {
                const Phone& phone = out.utterance.phones[place_of_.at(model.phones[p])];
                const std::int64_t middle = (phone.start + phone.end) / 2;
                if (middle < span.start || middle >= span.end) continue;
                const long end =
                    p + 1 < model.phones.size() ? model.begins[p + 1] : model.features.cols();
                for (long i = model.begins[p]; i < end; ++i, ++count)
                    sum += path.distance[static_cast<std::size_t>(i)];
            }
            means.push_back(count ? sum / static_cast<double>(count) : 0);
        }
        std::vector<double> sorted = means;
        std::sort(sorted.begin(), sorted.end());
        const double median = sorted.empty() ? 0 : sorted[sorted.size() / 2];
        for (const double mean : means) out.words.push_back({median > 0 ? mean / median : 1});
    }

    SoundView recording_;
    const Utterance said_;
    const PhoneTable& table_;
    std::string place_;
    SoundFrames frames_, voice_frames_;
    std::vector<bool> silent_;
    std::vector<std::size_t> order_;  ///< phones of the voice that are no pauses
    std::map<std::size_t, std::size_t>
        place_of_;  ///< from phones of the voice to those of the recording
};

}  // namespace

double spoken_seconds(const SoundView& sound, const std::string& place) {
    return checked_frames(sound, top_of_bands_hz(sound.rate_hz, sound.rate_hz), place).spoken_s();
}

Alignment align(const SoundView& recording, const SaidByVoice& voice, const PhoneTable& table,
                const std::string& place) {
    return Aligner(recording, voice, table, place).align();
}

}  // namespace risorius::speech
