// SPDX-License-Identifier: MIT
/// \file
/// Something that is said: its phones, words and sentences with their times. Format "risorius-utterance", version 1; field names
/// are its keys.
///
/// Times are integer samples of the sound, so that an asynchrony of one sample is exact. An interval [start, end) does not contain
/// the sample `end`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/speech/phone_table.h"

namespace risorius::speech {

/// One phone. Pauses are phones too; their symbol is "_".
struct Phone {
    std::string symbol;   ///< IPA, with marks, without length and stress
    int length_mark = 0;  ///< 0 short, 1 half long, 2 long
    int stress = 0;       ///< 0 none, 1 secondary, 2 primary
    std::int64_t start = 0, end = 0;
    /// Moments in the sound, see landmarks.h: the closure of a stop or nasal begins; it is released; the voice begins.
    std::optional<std::int64_t> closure, release, voice_onset;

    bool is_pause() const { return symbol == kPause; }
    /// The symbol with its length mark.
    std::string text() const;
};

/// A word or a sentence.
struct Span {
    std::string text;
    std::int64_t start = 0, end = 0;
};

/// Where an utterance comes from.
struct UtteranceSource {
    std::string program, version;
    std::string sha256;  ///< of the file of labels or sound it was made of; may be empty
};

struct Utterance {
    int rate_hz = 48000;          ///< of the sound, 1000..768000
    std::int64_t samples = 0;     ///< length of the sound
    std::string language;         ///< BCP 47, "fi"; may be empty
    std::filesystem::path sound;  ///< WAV or FLAC file; empty: none
    std::vector<Phone>
        phones;  ///< in the order of time; they touch each other, and cover the sound from the first on
    std::vector<Span> words, sentences;
    UtteranceSource source;

    double seconds(std::int64_t sample) const { return static_cast<double>(sample) / rate_hz; }
    /// The index of the word at a sample; -1 when there is none.
    int word_at(std::int64_t sample) const;
};

/// The phones of a label that was split, one after another from `start` to `end`; those shorter than a sample are left out.
std::vector<Phone> timed_phones(const std::vector<SplitPhone>& parts, std::int64_t start,
                                std::int64_t end);

/// The greatest number of samples: what JSON and all readers can hold.
inline constexpr std::int64_t kMaxSamples = 2147483647;

/// Reads a file. Throws Error that names file and place, also for phones that overlap or symbols that `table` does not know.
Utterance read_utterance(const JsonCursor& json, const PhoneTable& table);
Utterance read_utterance(const std::filesystem::path& file, const PhoneTable& table);

/// The text of the file. A path is written as it is.
std::string utterance_text(const Utterance& utterance);

/// Half an hour of fast speech, and more than anybody holds a sound.
inline constexpr std::size_t kMostPhones = 30000;
inline constexpr double kMostMinutes = 30, kLongestPhone_s = 60;

/// Throws Error with `place` unless the times are in order, touch each other and lie within the sound, and all symbols are known.
void check_utterance(const Utterance& utterance, const PhoneTable& table, const std::string& place);

}  // namespace risorius::speech
