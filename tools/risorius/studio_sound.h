// SPDX-License-Identifier: MIT
/// \file
/// What an open script says, for the page of the studio: its phones and words with their times, and its sound.
#pragma once

#include <memory>
#include <string>

#include "risorius/talk/say_event.h"

namespace risorius::cli {

struct ScriptSound {
    /// {"type": "speech", "start_s": 0.2, "sound": true, "phones": [["a", 0.5, 0.62], ...], "words": [["aka", 0.5, 0.9], ...]}; times
    /// are of the script, s, and pauses are left out.
    std::string message;
    std::shared_ptr<const std::string> wav;  ///< 16-bit samples of one channel; null: no sound
};

ScriptSound sound_of(const talk::PlannedSpeech& speech);

bool same_sound(const ScriptSound& a, const ScriptSound& b);

}  // namespace risorius::cli
