// SPDX-License-Identifier: MIT
/// \file
/// Text to sound: starts a synthesiser, which is a program of its own, and makes an utterance of what it returns.
///
/// The program gets the names of three files: a request in JSON, a WAV file and a table to write. rigs/standard/voices.json names the
/// programs; tools/voices/espeak/README.md describes the files.
#pragma once

#include <string>
#include <vector>

#include "risorius/speech/utterance.h"

namespace risorius::talk {

struct VoiceRequest {
    std::string text{};
    std::string phones{};  ///< mnemonics of the program, instead of a text
    std::string language = "en-us";
    std::string program{};  ///< a name of voices.json; empty: the first that speaks the language
    double rate = 1;        ///< 1: as fast as people read, [0.3, 3]
    int pitch = 50;         ///< [0, 99]
};

/// What was said, and its sound.
struct Spoken {
    speech::Utterance utterance;
    std::vector<float> sound;  ///< one channel at the utterance's rate
    /// How much later the voice marks borders between voiced sounds than people do, s, see speech::SaidByVoice
    double late_s = 0;
};

/// Without a name of a program, voices that are not installed are passed over. Throws Error for a request that the program refuses and when the program is not installed; the message names its package.
Spoken speak(const VoiceRequest& request, const speech::PhoneTable& table);

}  // namespace risorius::talk
