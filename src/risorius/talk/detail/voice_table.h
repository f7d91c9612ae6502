// SPDX-License-Identifier: MIT
/// \file
/// The table that a synthesiser writes, and the utterance that is made of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/speech/utterance.h"

namespace risorius::talk {

/// One row: "phone", "word", "sentence", "ipa" or "end".
struct VoiceRow {
    std::string kind;
    std::int64_t sample = 0;
    int char_start = 0, char_length = 0;  ///< in characters, from 1
    std::string symbol;
};

struct VoiceTable {
    std::vector<VoiceRow> rows;
    std::string program;  ///< name and version from the comment at the end
};

/// Throws Error that names the line.
VoiceTable parse_voice_table(const std::string& text, const std::string& name);

/// How a voice spells its phones.
struct VoiceSymbols {
    std::string set = "espeak";
    std::map<std::string, std::string>
        replace;  ///< phones of a language that the voice spells otherwise
};

/// Makes an utterance. Names of events hold one or more phones; length and stress are taken from the rows "ipa", which are
/// aligned with the events. Phones that are closer than 3 ms are one. `samples`: length of the sound.
speech::Utterance utterance_of_voice(const VoiceTable& table, const std::string& text,
                                     const VoiceSymbols& symbols, int rate_hz, std::int64_t samples,
                                     const speech::PhoneTable& phones);

}  // namespace risorius::talk
