// A design as read: which scripts with which values, what is shown beside them, and how the clips are written.
// JSON format "risorius-design", version 1; field names are its keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/design/detail/controls.h"
#include "risorius/design/detail/crossing.h"
#include "risorius/design/detail/parameters.h"

namespace risorius::design {

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
        rows;  ///< of "conditions"; one row of nothing when there is none
    std::vector<Relation> fraction = {};  ///< of the crossing, those that all of them keep
    std::optional<int> draw;              ///< so many of these, by chance
    std::vector<Override> overrides;
    std::string clip;  ///< pattern of names
    std::vector<Control> controls;
    std::optional<JsonCursor> audio;          ///< a WAV or FLAC file, with ${names} in it
    std::optional<JsonCursor> audio_start_s;  ///< of its first sample, or a formula
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

/// Pictures of the same mean and spread of luminance (media/luminance.h): an affine map of linear light, for all frames of all
/// clips, or for all of each clip. Measured are the conditions; their controls are shown through the same map.
struct LuminanceMatch {
    bool within_face = false;  ///< measured in the oval of the face, else in the whole picture
    bool per_clip = false;
    std::optional<double> mean, sd;  ///< (0, 1); those of the set where they are not given
};

struct Match {
    std::optional<LuminanceMatch> luminance;
    std::optional<double> loudness_lufs;  ///< of every clip's sound
};

/// What an example of an experiment with the set asks of a participant.
struct ExperimentOptions {
    std::vector<std::string> programs;  ///< "psychopy", "jspsych"
    std::string question = "Which one was it?";
    std::vector<std::pair<std::string, std::string>> answers;  ///< key to press, what it stands for
    std::optional<std::string>
        correct;                    ///< parameter of the design whose value is the right answer
    std::vector<std::string> sets;  ///< clips of these; all when empty
    bool controls = true;           ///< are shown too
    int repetitions = 1;
    double fixation_s = 0.5;
    std::string jspsych_from =
        "https://cdn.jsdelivr.net/npm";  ///< packages of jsPsych, a URL or a folder
};

struct Design {
    std::filesystem::path file;
    std::string name;
    int seed = 1;
    ClipOptions clips;
    Match match;
    std::optional<ExperimentOptions> experiment;
    std::vector<Given> parameters;
    std::vector<ConditionSet> sets;
};

/// Throws Error naming file, place, expected and found.
Design read_design(const std::filesystem::path& file);

}  // namespace risorius::design
