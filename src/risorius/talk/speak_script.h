// SPDX-License-Identifier: MIT
/// \file
/// A script in which a face says one utterance, and nothing else.
#pragma once

#include <filesystem>
#include <optional>

#include "risorius/core/json_cursor.h"
#include "risorius/speech/utterance.h"
#include "risorius/speech/windows.h"

namespace risorius::talk {

struct SpeakScriptOptions {
    std::filesystem::path rig;         ///< as it is written in the script
    std::filesystem::path utterance;   ///< the same
    std::optional<JsonCursor> base{};  ///< a script to which the event is added
    speech::SpeechStyle style{};
    double gestures = 0, blinks = 0, gaze = 0;  ///< of "style"
    std::vector<speech::ClosureChange> adjust{};
    int fps = 60;
};

/// The event begins so late that the face can move before the first sound, and the script lasts until the face is at rest again. A
/// script to add to keeps its keys, and becomes longer when it is too short. Throws Error when that has no events of its own form.
Json speak_script(const speech::Utterance& utterance, const SpeakScriptOptions& options);

}  // namespace risorius::talk
