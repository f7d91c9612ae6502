// SPDX-License-Identifier: MIT
/// \file
/// The events "say" of a script: what is said, when, how, and with which sound.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/scene/rig_files.h"
#include "risorius/speech/windows.h"
#include "risorius/talk/spoken_input.h"
#include "risorius/track/script.h"

namespace risorius::talk {

struct SayEvent {
    SpokenInput input;
    /// Phones with durations instead of a text, s
    std::vector<std::pair<std::string, double>> timed_phones;
    double start_s = 0;  ///< time of the first sample of the sound
    /// When the first stop or nasal is released, in place of start_s
    std::optional<double> burst_s;
    speech::SpeechStyle style;
    double gestures = 0, blinks = 0, gaze = 0;  ///< keys of "style", see speech::ProsodyOptions
    std::vector<speech::ClosureChange> adjust;  ///< "adjust": closures, as a check found them
    bool face = true;                           ///< false: only the sound, with a still face
    bool sound = true;                          ///< false: "none"
    std::filesystem::path sound_file;           ///< another sound than the spoken one; may be empty
    std::int64_t sound_offset_samples = 0;      ///< moves the sound, in its samples; > 0: later
    std::optional<double> snr_db;  ///< level of the speech over noise that is added to its sound
    std::uint64_t noise_seed = 1;
    std::string place;  ///< in messages
};

/// Reads one event. Throws Error; the message names the place.
SayEvent read_say(const JsonCursor& event, double duration_s);

/// An utterance in a script.
struct PlacedUtterance {
    speech::Utterance utterance;
    speech::ArticulationTargets targets;  ///< without changes of closures
    double start_s = 0;
    bool face = true;
};

/// What all events of a script make.
struct PlannedSpeech {
    std::vector<PlacedUtterance> utterances;
    std::vector<std::shared_ptr<const track::DriveSource>> sources;
    std::vector<track::BlinkEvent> blinks;
    /// The sound, if there is one; it may be a file that `keeps` removes at its end.
    std::filesystem::path sound_file;
    std::int64_t sound_offset_samples = 0;
    std::shared_ptr<void> keeps;
    std::vector<std::filesystem::path> files;  ///< that were read
    std::vector<std::string> notes;            ///< what a person should know
};

/// How plan_speech() gets the mouths of a rig, which take minutes to simulate when they are not known yet.
struct MouthPoses {
    std::function<void(double fraction)> report{};  ///< of their simulation
    /// false: a script is only checked. Faces whose mouths are not known do not move, and a note says so.
    bool may_simulate = true;
};

/// Reads the events and plans the mouth. Throws Error when an event begins too early for the face to move before it, or when two
/// events have a sound.
PlannedSpeech plan_speech(const std::vector<JsonCursor>& says, const track::ScriptHeader& header,
                          const scene::RigFiles& files, const MouthPoses& poses = {});

/// Adds what speech asks of the face to a script.
void add_to_script(const PlannedSpeech& speech, track::ScriptDescription& script);

}  // namespace risorius::talk
