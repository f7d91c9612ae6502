// SPDX-License-Identifier: MIT
/// \file
/// Lets a script that is open say something: the edits of its JSON, and the sound. Nothing is simulated, so that the first picture
/// follows the text within a fraction of a second.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/talk/voice.h"

namespace risorius::talk {

struct SayEdit {
    Json edits;          ///< [{"path": "/events/0", "value": {...}}, ...], as the studio reads them
    double start_s = 0;  ///< first sample of the sound, in the script
    double end_s = 0;    ///< when the face is at rest again
    std::string wav;     ///< the sound, bytes of a WAV file
};

/// The face begins to move at `at_s`. Earlier events "say" of the script lose their sound, because a script has one; the script
/// becomes longer when it ends too early. Throws Error as speak() does.
SayEdit say_edit(const Json& script, const VoiceRequest& request, double at_s);

}  // namespace risorius::talk
