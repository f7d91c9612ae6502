// SPDX-License-Identifier: MIT
/// \file
/// What `risorius speak` is asked for.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/animate/render_request.h"
#include "risorius/speech/windows.h"
#include "risorius/talk/spoken_input.h"
#include "tools/risorius/terminal.h"

namespace risorius::cli {

struct SpeakArguments {
    Common common;
    talk::SpokenInput input;
    animate::RenderRequest render;  ///< its `out` is that of all kinds of output
    std::string said, size;
    std::filesystem::path script;
    speech::SpeechStyle style;
    double gestures = 0.6, blinks = 1, gaze = 1;
    int passes = 6;
};

/// Standard output and input as names of files.
inline constexpr const char* kStandard = "-";

/// Writes a film to standard output while it is made, see media/live_stream.h. The text is that of the arguments or, where it is "-",
/// each line of standard input as it comes. Closures of the lips are not checked. Throws Error and RunError.
void speak_live(SpeakArguments& arguments);

}  // namespace risorius::cli
