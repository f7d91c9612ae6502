// SPDX-License-Identifier: MIT
/// \file
/// A design as read from its file: scripts and the values that vary in them, controls, and how clips are written.
/// JSON format "risorius-design", version 1; field names are its keys.
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

/// A factor of the experiment. Each level is a value of a parameter.
struct Factor {
    std::string name;
    std::vector<JsonCursor> levels;
};

/// Values of parameters for the conditions that have all values of `when`.
struct Override {
    std::vector<Given> when, set;
};

/// The conditions of one script: all combinations of the levels of its factors, for each row of its table.
struct ConditionSet {
    std::string name;
    JsonCursor script;              ///< the template
    std::vector<Given> parameters;  ///< of this set; they replace those of the design
    std::vector<Factor> factors;
    std::vector<std::vector<Given>>
        rows;  ///< the table "conditions"; without one, a single empty row
    std::vector<Relation> fraction = {};  ///< only combinations that satisfy all of these relations
    std::optional<int> draw;              ///< a random choice of this many of them
    std::vector<Override> overrides;
    std::string clip;  ///< pattern of the names of clips
    std::vector<Control> controls;
    std::optional<JsonCursor> audio;          ///< a WAV or FLAC file; may contain ${names}
    std::optional<JsonCursor> audio_start_s;  ///< time of its first sample, or a formula
    std::string place;
};

/// How every clip is written.
struct ClipOptions {
    std::string ending = "mp4";  ///< mp4, mov, mkv or webm
    std::string quality = "video";
    std::optional<int> crf;
    bool lossless = false;
    bool landmarks = true;  ///< their places in the table of frames
    std::optional<std::string> photodiode;
};

/// Matches mean and standard deviation of luminance (media/luminance.h) by an affine map of linear light, one for all clips or one for
/// each clip. Only conditions are measured; their controls are shown through the same map.
struct LuminanceMatch {
    bool within_face =
        false;  ///< measured within the oval of the face, or else in the whole picture
    bool per_clip = false;
    std::optional<double> mean, sd;  ///< the target, (0, 1); not given: that of the set
};

struct Match {
    std::optional<LuminanceMatch> luminance;
    std::optional<double> loudness_lufs;  ///< the target loudness of the sound of each clip
};

/// The example experiment: what a participant sees, and is asked.
struct ExperimentOptions {
    std::vector<std::string> programs;  ///< "psychopy", "jspsych"
    std::string question = "Which one was it?";
    std::vector<std::pair<std::string, std::string>> answers;  ///< key to press, what it stands for
    std::optional<std::string>
        correct;                    ///< the parameter of the design whose value is the right answer
    std::vector<std::string> sets;  ///< the sets whose clips are shown; empty: all
    bool controls = true;           ///< whether controls are shown too
    int repetitions = 1;
    double fixation_s = 0.5;
    std::string jspsych_from =
        "https://cdn.jsdelivr.net/npm";  ///< packages of jsPsych: a URL or a folder
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
