// SPDX-License-Identifier: MIT
/// \file
/// A design as read from its file: scripts, the values that vary in them, controls, and how clips are written. The JSON format is
/// "risorius-design", version 1; fields have the names of its keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/design/detail/controls.h"
#include "risorius/design/detail/crossing.h"
#include "risorius/design/detail/parameters.h"
#include "risorius/design/sample.h"

namespace risorius::design {

/// A factor of the experiment. Each level is a value of a parameter.
struct Factor {
    std::string name;
    std::vector<JsonCursor> levels;
    bool drawn =
        false;  ///< whether the levels were drawn at random; then names of clips have four digits of them
};

/// Values of parameters that apply to conditions with all values of `when`.
struct Override {
    std::vector<Given> when, set;
};

/// The conditions of one script: all combinations of the levels of its factors, for each row of its table.
struct ConditionSet {
    std::string name;
    JsonCursor script;  ///< the template
    /// Parameters of this set; they take precedence over those of the design
    std::vector<Given> parameters;
    std::vector<Factor> factors;
    /// Rows of the table "conditions"; one empty row if there is no table
    std::vector<std::vector<Given>> rows;
    /// Relations between levels (crossing.h); only combinations that satisfy all of them are used
    std::vector<Relation> fraction = {};
    std::optional<int> draw;  ///< number of combinations that are chosen at random
    std::vector<Override> overrides;
    std::string clip;  ///< pattern of the names of clips; it may contain ${names}
    std::vector<Control> controls;
    std::optional<JsonCursor> audio;          ///< a WAV or FLAC file; may contain ${names}
    std::optional<JsonCursor> audio_start_s;  ///< time of its first sample, or a formula
    /// Random facial movements, and the trial of each row
    std::optional<SampleOptions> sample = {};
    std::vector<Trial> trials = {};
    std::string place;
};

/// How every clip is written.
struct ClipOptions {
    std::string ending = "mp4";     ///< mp4, mov, mkv or webm; png: each clip is one picture
    std::optional<double> still_s;  ///< of pictures: when in the script, s; default: at the apex
    double shown_s = 1;             ///< of pictures: how long an experiment shows each, s
    std::string quality = "video";
    std::optional<int> crf;
    bool lossless = false;
    bool landmarks = true;  ///< whether the table of frames has the positions of landmarks
    std::optional<std::string> photodiode;
    /// Frames from one key frame of the codec to the next; default: only the first frame of clips of up to 10 s
    std::optional<int> keyframe_interval;
    std::vector<std::string> aois;  ///< areas of interest for eye tracking, of aoi_names()
    double aoi_margin = 0.03;       ///< how much they are grown / width of the face, [0, 0.2]

    bool pictures() const { return ending == "png"; }
};

/// The names of areas of interest.
const std::vector<std::string>& aoi_names();

/// Matches mean and standard deviation of luminance (media/tone.h) by an affine function of linear light. The background is not
/// changed. Only conditions are measured; controls are mapped as their condition is.
struct LuminanceMatch {
    /// True: only the oval of the face is measured, not the whole picture
    bool within_face = false;
    /// One map for all clips; for all clips of a head in a view; or for each clip and its controls
    enum class OneFor { kAll, kIdentity, kClip } one_for = OneFor::kAll;
    /// Targets, (0, 1); if they are not given, they are computed from the whole set
    std::optional<double> mean, sd;
    /// Largest fraction of channel values that may be clipped at black and white in a clip
    double cut_limit = 0.005;
    bool allow_clipping = false;  ///< whether more is a note instead of an error
    /// Whether all groups get the same histogram, and the same amplitude at each spatial frequency, in so many rounds
    bool histogram = false, spectrum = false;
    int rounds = 10;
    bool grey = false;  ///< whether the face is shown without colour
    bool has_maps() const { return histogram || spectrum; }
};

/// Makes movements equal as they are seen, and sets parameters by search.
struct MotionMatch {
    /// Levels of the factor "seen_step", which is added: shares of the motion at full intensity, (0, 1]. None: steps are as given
    std::vector<JsonCursor> share;
    std::string of;                   ///< the parameter, an intensity
    std::optional<double> apex_s;     ///< when the movement is at its apex, s
    std::string apex_of = "onset_s";  ///< the parameter, a duration in s
};

/// What is made equal in all clips.
struct Match {
    std::optional<MotionMatch> motion;
    std::optional<LuminanceMatch> luminance;
    std::optional<double> loudness_lufs;  ///< target loudness of the sound of each clip
};

/// The example experiment: what is shown to a participant, and which question is asked.
struct ExperimentOptions {
    std::vector<std::string> programs;  ///< "psychopy", "jspsych", "rating"
    std::string question = "Which one was it?";
    std::vector<std::pair<std::string, std::string>> answers;  ///< key to press, and its meaning
    /// Parameter of the design whose value is the right answer
    std::optional<std::string> correct;
    std::vector<std::string> sets;  ///< sets whose clips are shown; empty: all
    bool controls = true;           ///< whether controls are also shown
    int repetitions = 1;
    double fixation_s = 0.5;
    bool answer_during = false;  ///< whether a key pressed while the clip is shown is the answer
    int blocks = 1;              ///< with a pause between two of them
    int practice = 0;  ///< trials before the first block, which tell whether an answer is right
    double catch_share = 0;  ///< trials with a dot to be reported / trials, [0, 0.5]
    /// Which clip comes next. Constant: all, in random order. Staircase, QUEST and QUEST+: the one whose level is nearest to where the
    /// participant's threshold is looked for.
    enum class Method { kConstant, kStaircase, kQuest, kQuestPlus } method = Method::kConstant;
    std::string over = "seen_share";     ///< the level: "seen_share", or a parameter with numbers
    std::vector<std::string> series_by;  ///< parameters; each combination of values has a threshold
    int trials = 40;                     ///< of each threshold
    /// What a rater is asked for each clip, of rating_scales()
    std::vector<std::string> scales;
    /// Packages of jsPsych: a URL or a folder
    std::string jspsych_from = "https://cdn.jsdelivr.net/npm";
};

/// The names of ExperimentOptions::Method in design files, in their order.
const std::vector<std::string>& method_names();

/// The scales of ratings: "valence", "arousal", "intensity", "naturalness".
const std::vector<std::string>& rating_scales();

/// The codes that go out with the clips.
struct TriggerOptions {
    double pulse_ms = 10;  ///< minimum time that a code stays on the line
    /// Parameters, or "control", whose values choose the code of clip_on; "stim_id": each clip has its own. None: it is always 1.
    std::vector<std::string> code_by;
    bool response = false;  ///< whether an answer has a code too
    bool lsl = false;       ///< whether the codes are also markers of the Lab Streaming Layer
    std::string wait_for;   ///< key that the pulses of a scanner press; empty: no scanner
    int dummy_volumes = 0;  ///< pulses before the one that begins the run
};

/// What the data set says about itself.
struct DatasetOptions {
    std::vector<std::string> authors;
    std::string license = "n/a", copyright = "n/a";
};

/// The content of a design file.
struct Design {
    std::filesystem::path file;
    std::string name;
    int seed = 1;
    ClipOptions clips;
    Match match;
    std::optional<ExperimentOptions> experiment;
    DatasetOptions dataset;
    TriggerOptions triggers;
    std::vector<Given> parameters;
    std::vector<ConditionSet> sets;
};

/// Reads a design. Throws Error with file, place, and the expected and the found value.
Design read_design(const std::filesystem::path& file);

}  // namespace risorius::design
