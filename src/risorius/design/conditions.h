// SPDX-License-Identifier: MIT
/// \file
/// The clips that a design asks for, each with its name, its values and its script.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/design/design.h"

namespace risorius::design {

/// The maximum number of clips. A crossing is counted before it is made.
inline constexpr long kMaxConditions = 100000;

struct Condition {
    std::string
        clip;  ///< the name: letters and digits, as in stim-LABEL of BIDS; unique without regard to case
    std::string set;
    Control control;
    std::string of;  ///< the clip that this one is a control of; its own name when it is no control
    std::vector<std::pair<std::string, Json>> values;  ///< all parameters, by name
    Json script;                   ///< with all values filled in, and changed for the control
    std::filesystem::path folder;  ///< where its relative paths start
    unsigned seed = 0;             ///< of the random numbers of the control
    std::optional<std::filesystem::path> audio;  ///< the recording that is heard
    double audio_start_s = 0;                    ///< the time of its first sample
};

/// Throws Error for names that are not valid or not unique, for unknown parameters and for too many conditions.
std::vector<Condition> conditions_of(const Design& design);

/// Text as a part of a clip's name: "0.25" -> "0p25", "zygomaticus_major.l" -> "ZygomaticusMajorL", -3 -> "m3".
std::string clip_word(const std::string& text);

}  // namespace risorius::design
