// SPDX-License-Identifier: MIT
/// \file
/// Files of labels: which phone or word is when. Reads those of Praat (TextGrid), recognisers (CTM), HTK (.lab), Audacity,
/// MBROLA and espeak (.pho), Festival (.seg), subtitles (WebVTT, SRT), Rhubarb (TSV, XML, JSON) and others; see
/// docs/formats/labels.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/speech/utterance.h"

namespace risorius::speech {

/// An interval with its text, in samples.
struct Label {
    std::int64_t start = 0, end = 0;
    std::string text;
    std::string place;  ///< "file:12", where it is in the file
};

struct LabelTier {
    std::string name;  ///< as in the file, or "phones", "words", "visemes" by the format
    std::vector<Label> labels;
};

struct LabelFile {
    std::string format;  ///< a name of label_formats()
    std::vector<LabelTier> tiers;
    std::int64_t samples = 0;  ///< where the file ends; that of the last label when it does not say
};

/// Names of the formats: "textgrid", "ctm", "lab", "audacity", "pho", "seg", "vtt", "srt", "rhubarb", ...
const std::vector<std::string>& label_formats();

/// The format of a file by its ending and its beginning. Throws Error when it is none of those above.
std::string label_format_of(std::string_view text, const std::filesystem::path& file);

/// Parses the bytes of a file; times are rounded to the nearest sample at `rate_hz`. `name` is the place in messages. Throws Error
/// that names file and line for malformed text, times that do not rise, and labels that overlap by more than a millisecond.
LabelFile parse_labels(const std::string& bytes, const std::string& format, const std::string& name,
                       int rate_hz);

/// Reads a file. An empty `format` is found by label_format_of().
LabelFile read_labels(const std::filesystem::path& file, const std::string& format, int rate_hz);

/// Which tiers become phones and words, and how the phones are spelt. Empty names: chosen by their usual names.
struct LabelOptions {
    std::string phones_tier, words_tier;
    std::string
        symbols;  ///< a set of PhoneTable::sets(); empty: that of the format, or found by the labels
    std::string language;
};

/// Makes an utterance of labels. `samples`: length of the sound; empty: the end of the labels. Gaps between labels are pauses.
/// Throws Error for tiers and symbols that are unknown, and for labels past the end of the sound.
Utterance utterance_of_labels(const LabelFile& labels, const LabelOptions& options,
                              const PhoneTable& table, int rate_hz,
                              std::optional<std::int64_t> samples, const std::string& name);

/// Writes tiers. Times have as many digits as are needed to read the same samples again.
std::string textgrid_text(const Utterance& utterance, const PhoneTable& table);
std::string ctm_text(const Utterance& utterance);     ///< phones, channel 1
std::string htk_text(const Utterance& utterance);     ///< phones, in units of 100 ns
std::string webvtt_text(const Utterance& utterance);  ///< words
std::string rhubarb_text(const Utterance& utterance, const PhoneTable& table);  ///< mouth shapes

}  // namespace risorius::speech
