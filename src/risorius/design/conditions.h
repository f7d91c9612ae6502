// Every clip that a design asks for: its name, its values and its script. Checked as a whole.
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

/// More are refused; a crossing is counted before it is made.
inline constexpr long kMostConditions = 100000;

struct Condition {
    std::string
        clip;  ///< letters and digits, as BIDS wants of a stim-LABEL; no two alike but for case
    std::string set;
    Control control;
    std::string of;  ///< the clip that it is a control of; itself when it is none
    std::vector<std::pair<std::string, Json>> values;  ///< of all parameters, by name
    Json script;                                       ///< filled in, as the control wants it
    std::filesystem::path folder;                      ///< where its relative paths start
    unsigned seed = 0;                                 ///< of what the control draws
    std::optional<std::filesystem::path> audio;        ///< a recording to be heard
    double audio_start_s = 0;                          ///< when its first sample is
};

/// Throws Error for names that are no file names or taken twice, unknown parameters, and too many.
std::vector<Condition> conditions_of(const Design& design);

/// Text as a part of a clip's name: "0.25" -> "0p25", "zygomaticus_major.l" -> "ZygomaticusMajorL", -3 -> "m3".
std::string clip_word(const std::string& text);

}  // namespace risorius::design
