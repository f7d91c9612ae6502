// SPDX-License-Identifier: MIT
/// \file
/// The clips of a design, each with its name, its values and its script.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/design/design.h"

namespace risorius::design {

/// The maximum number of clips. It is checked before a crossing is expanded.
inline constexpr long kMaxConditions = 100000;

/// One clip of a design.
struct Condition {
    /// Name of letters and digits, as in stim-LABEL of BIDS; unique without regard to case
    std::string clip;
    std::string set;
    Control control;
    /// Name of the clip that this one is a control of; its own name if it is not a control
    std::string of;
    std::vector<std::pair<std::string, Json>> values;  ///< all parameters, by name
    Json script;        ///< with all values filled in, and changed as the control requires
    Json lower_script;  ///< of a chimeric clip: the script of the lower half; null in others
    std::filesystem::path folder;                ///< folder to which its relative paths refer
    unsigned seed = 0;                           ///< seed of the random numbers of the control
    std::optional<std::filesystem::path> audio;  ///< recording of the sound
    double audio_start_s = 0;                    ///< the time of its first sample
    std::vector<UnitCourse> units;               ///< what "sample" has drawn, in the script
};

/// The factor of match/motion.
inline constexpr const char* kSeenStep = "seen_step";

/// What finds the values that match/motion asks for. `script_at`: the script of a condition with a value of the parameter; `folder`: where
/// its relative paths start; `place`: the condition in messages.
struct MotionSearch {
    using Script = std::function<Json(double)>;
    using Find =
        std::function<double(double wanted, const Script& script_at,
                             const std::filesystem::path& folder, const std::string& place)>;
    Find intensity;  ///< for a share of the motion at full intensity
    Find time_s;     ///< for the time of the apex, s
};

/// How often conditions_of() asks for a value of match/motion, for the progress.
long motion_searches(const Design& design);

/// Returns all clips of a design. `search`: needed when the design matches motion. Throws Error for names that are invalid or not unique,
/// for unknown parameters and for too many conditions.
std::vector<Condition> conditions_of(const Design& design, const MotionSearch& search = {});

/// Converts text to a part of a clip's name: "0.25" -> "0p25", "zygomaticus_major.l" -> "ZygomaticusMajorL", -3 -> "m3".
std::string clip_word(const std::string& text);

}  // namespace risorius::design
