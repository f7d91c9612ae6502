// SPDX-License-Identifier: MIT
/// \file
/// Controls: how a condition can be shown for comparison. A control shows the same pictures in another order or upside down, or plays
/// the script with something missing in the face.
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
    kScrambled,       ///< frames in a random order
    kApex,            ///< only the frame that differs most from the first
    kUpsideDown,      ///< pictures rotated by 180 degrees
    kPhaseScrambled,  ///< the amplitude spectrum of each picture with random phases
    kEyesOnly,        ///< only a window around the eyes
    kMouthOnly,       ///< only a window around the mouth
    kFlipped,         ///< vertical motion mirrored, which no real face can do
    kNeutral,         ///< the face at rest, of the same length
    kKnockOut,        ///< the script without one muscle
    kPalsy,           ///< one half of the face is weak
    kLateSide         ///< one half of the face is later than the other
};

/// The names in design files, in the order of the enumeration from kReversed on.
const std::vector<std::string>& control_names();

struct Control {
    ControlKind kind = ControlKind::kNone;
    std::string muscle;  ///< kKnockOut: the name of a channel of the script, with or without a side
    std::string side;    ///< kPalsy, kLateSide: "left" or "right"
    double weakness = 1;               ///< kPalsy: fraction of the strength that is missing, [0, 1]
    double late_s = 0.1;               ///< kLateSide
    std::map<std::string, Json> when;  ///< only for conditions with these values

    /// Whether the control shows the pictures of the condition in another way, and does not change the face.
    bool shows_otherwise() const;
    std::string name() const;  ///< for names of files: "reversed", "withoutZygomaticusMajorL"
};

/// Reads a name, or an object with "control" and its parameters. Throws Error.
Control read_control(const JsonCursor& json);

/// The script of a condition changed for the control; unchanged when only pictures change.
Json controlled(Json script, const Control& control);

/// The frame of the condition that each frame of the control shows. `apex`: the frame that differs most from the first.
std::vector<int> frame_order(const Control& control, int frames, int apex, unsigned seed);

}  // namespace risorius::design
