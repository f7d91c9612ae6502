// SPDX-License-Identifier: MIT
/// \file
/// A recording whose text is known: a voice says the text as fast as the recording does, and both sounds are aligned.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/speech/align.h"
#include "risorius/talk/voice.h"

namespace risorius::talk {

struct AlignedRecording {
    speech::Alignment alignment;
    std::vector<float> sound;  ///< of the recording, one channel at the utterance's rate
    double rate = 1;  ///< VoiceRequest::rate at which the voice was as fast as the recording
};

/// `file`: WAV or FLAC. `said.rate` is where the search for the rate begins. Throws Error as speak() and speech::align() do.
AlignedRecording align_recording(const std::filesystem::path& file, VoiceRequest said,
                                 const speech::PhoneTable& table);

/// A table of how well an alignment fits: a row for each word, with its times and its misfit, and one for each pause.
std::string alignment_report(const speech::Alignment& alignment);

}  // namespace risorius::talk
