// SPDX-License-Identifier: MIT
/// \file
/// What a whole script says, as labels in the time of the script.
#pragma once

#include <string>
#include <vector>

#include "risorius/talk/say_event.h"

namespace risorius::talk {

/// One utterance of `duration_s` that holds all others, moved to where the script has them. What begins before an earlier one has
/// ended is left out. Without phones when nothing of them lies within the script.
speech::Utterance utterance_of_script(const std::vector<PlacedUtterance>& said, double duration_s);

/// The same as a TextGrid; empty without phones.
std::string script_textgrid(const std::vector<PlacedUtterance>& said, double duration_s);

}  // namespace risorius::talk
