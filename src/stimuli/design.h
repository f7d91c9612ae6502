// A design as read: which scripts with which values, what is shown beside them, and how the clips are written.
// JSON format "risorius-design", version 1; field names are its keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json_cursor.h"
#include "stimuli/controls.h"
#include "stimuli/parameters.h"

namespace risorius::stimuli {

/// One thing that varies: every level is a value of a parameter.
struct Factor {
    std::string name;
    std::vector<JsonCursor> levels;
};

/// For the conditions that have all values of "when": other values of parameters.
struct Override {
    std::vector<Given> when, set;
};

/// Conditions of one script: every level of every factor with every other, for every row of the table.
struct ConditionSet {
    std::string name;
    JsonCursor script;              ///< the template
    std::vector<Given> parameters;  ///< of this set, over those of the design
    std::vector<Factor> factors;
    std::vector<std::vector<Given>>
        rows;                 ///< of "conditions"; one row of nothing when there is none
    std::optional<int> draw;  ///< so many of the crossing, by chance
    std::vector<Override> overrides;
    std::string clip;  ///< pattern of names
    std::vector<Control> controls;
    std::string place;
};

/// How every clip is written.
struct ClipOptions {
    std::string ending = "mp4";  ///< mp4, mov, mkv or webm
    std::string quality = "video";
    std::optional<int> crf;
    bool lossless = false;
    bool landmarks = true;  ///< in the table of frames
    std::optional<std::string> photodiode;
};

struct Design {
    std::filesystem::path file;
    std::string name;
    int seed = 1;
    ClipOptions clips;
    std::vector<Given> parameters;
    std::vector<ConditionSet> sets;
};

/// Throws Error naming file, place, expected and found.
Design read_design(const std::filesystem::path& file);

}  // namespace risorius::stimuli
