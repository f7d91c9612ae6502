// SPDX-License-Identifier: MIT
/// \file
/// Controls: versions of a condition for comparison. A control shows the same pictures in another order, upside down or partly
/// covered, or plays a changed script.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

enum class ControlKind {
    kNone,            ///< the condition itself
    kReversed,        ///< last frame first
    kScrambled,       ///< frames in random order
    kApex,            ///< only the frame that differs most from the first
    kUpsideDown,      ///< pictures rotated by 180 degrees
    kPhaseScrambled,  ///< the amplitude spectrum of each picture with random phases
    kEyesOnly,        ///< only a window around the eyes
    kMouthOnly,       ///< only a window around the mouth
    kFlipped,         ///< vertical motion mirrored, which no real face can do
    kNeutral,         ///< the face at rest, for the same duration
    kKnockOut,        ///< the script without one muscle
    kPalsy,           ///< one half of the face is weak
    kLateSide,        ///< one half of the face moves later than the other
    kLowPass,         ///< only low spatial frequencies within the oval of the face
    kHighPass,        ///< only high ones
    kOval,            ///< only the oval of the face, with a soft rim
    kNoise,           ///< noise of luminance over the oval of the face
    kMirrored,        ///< left and right exchanged
    kBandPass,        ///< only middle spatial frequencies within the oval of the face
    kPointLight,      ///< only white dots where landmarks of the face are
    kMondrian,        ///< random rectangles, to mask the face from the other eye
    kSpeed,           ///< the same movement at a constant, rising or falling speed
    kChimeric         ///< the upper half of the face, over the lower half of another condition
};

/// The names of controls in design files, in the order of the enumeration from kReversed on.
const std::vector<std::string>& control_names();

/// How far a movement has come, by the share of its time, for kSpeed.
enum class Speed { kConstant, kAccelerated, kDecelerated };

/// A control and its parameters.
struct Control {
    ControlKind kind = ControlKind::kNone;
    std::string muscle;   ///< kKnockOut: a channel of the script, with or without a side
    std::string side;     ///< kPalsy, kLateSide: "left" or "right"
    double weakness = 1;  ///< kPalsy: missing fraction of the strength, [0, 1]
    double late_s = 0.1;  ///< kLateSide: delay
    /// kLowPass, kHighPass, kBandPass: where the gain is -3 dB, in cycles per width of the face between zy_l and zy_r; (0, 200]
    double cycles_per_face = 8;
    double upper_cycles_per_face =
        16;         ///< kBandPass: the upper end; cycles_per_face is the lower one
    int order = 4;  ///< of these three: of the Butterworth filter, [1, 16]
    bool keep_contrast =
        false;          ///< of these three: whether the standard deviation of luminance is restored
    double snr_db = 0;  ///< kNoise: power of the picture / power of the noise, [-40, 40]
    int dots = 60;      ///< kPointLight: their number, [2, 93]
    double radius = 0.01;    ///< kPointLight: of a dot / width of the face, [0.001, 0.1]
    bool scattered = false;  ///< kPointLight: whether each dot begins its way at a random place
    double rate_hz = 10;     ///< kMondrian: patterns per second, (0, 240]
    bool grey = true;        ///< kMondrian: whether the rectangles have no colour
    Speed speed = Speed::kConstant;  ///< kSpeed
    /// kChimeric: the values in which the condition of the lower half differs, at least one
    std::vector<std::pair<std::string, JsonCursor>> lower = {};
    double offset = 0;  ///< kChimeric: of the lower half to the right / width of the face, [-1, 1]
    std::map<std::string, Json> when;  ///< only conditions with these values get the control

    /// Returns whether the control changes only how the pictures of the condition are shown, and not the face.
    bool shows_otherwise() const;
    /// Returns whether the control changes the picture within the oval of the face, and so needs its opacity.
    bool changes_the_oval() const;
    /// Returns whether it is one of the filters kLowPass, kHighPass, kBandPass.
    bool passes() const;
    /// Returns whether its pictures depend on Condition::seed.
    bool is_random() const;
    /// Returns what its pictures depend on and name() does not tell; null for most controls.
    Json unnamed() const;
    std::string name() const;  ///< the name in file names: "reversed", "withoutZygomaticusMajorL"
};

/// Reads a control: a name, or an object with "control" and its parameters. Throws Error.
Control read_control(const JsonCursor& json);

/// Returns the script of a condition with the changes of the control. It is unchanged when the control changes only the pictures.
Json controlled(Json script, const Control& control);

/// Returns, for each of `frames` frames of kSpeed, the frame of a film with `finer` times as many. `way`: how far the face has moved in
/// each frame of the film; `onset`, `apex`: frames of the film. Between them the share of the way becomes t, t^2 or 1 - (1 - t)^2 of the
/// time t; before and after, the movement is as it was.
std::vector<int> retimed_order(Speed speed, const std::vector<double>& way, int onset, int apex,
                               int finer, int frames);

/// Returns, for each frame of the control, the frame of the condition that it shows. `apex`: the frame that differs most from the
/// first.
std::vector<int> frame_order(const Control& control, int frames, int apex, unsigned seed);

}  // namespace risorius::design
