// What a condition may be shown as beside itself, for comparison: the same pictures in another order or upside down, or the same
// script with something taken out of the face.
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
    kScrambled,       ///< frames in an order drawn by chance
    kApex,            ///< the frame farthest from the first, all the time
    kUpsideDown,      ///< turned by half a turn in the picture
    kPhaseScrambled,  ///< every spatial frequency as strong as it is, somewhere else
    kEyesOnly,        ///< nothing but what surrounds the eyes
    kMouthOnly,       ///< nothing but what surrounds the mouth
    kFlipped,         ///< everything goes down as far as it went up: no face can do that
    kNeutral,         ///< the face at rest for as long
    kKnockOut,        ///< without one muscle
    kPalsy,           ///< with one half of the face weak
    kLateSide         ///< one half of the face later than the other
};

/// In the order of the enumeration, from kReversed on, as design files write them.
const std::vector<std::string>& control_names();

struct Control {
    ControlKind kind = ControlKind::kNone;
    std::string
        muscle;  ///< kKnockOut: as the script names channels, "zygomaticus_major" or with a side
    std::string side;                  ///< kPalsy, kLateSide: "l" or "r"
    double weakness = 1;               ///< kPalsy: of all strength, [0, 1]
    double late_s = 0.1;               ///< kLateSide
    std::map<std::string, Json> when;  ///< for conditions with these values only

    /// Another way to show the pictures of the condition, rather than another face.
    bool shows_otherwise() const {
        return kind >= ControlKind::kReversed && kind <= ControlKind::kMouthOnly;
    }
    std::string name() const;  ///< for the file: "reversed", "withoutZygomaticusMajorL"
};

/// A name, or an object with "control" and what it needs. Throws Error.
Control read_control(const JsonCursor& json);

/// The script of a condition as the control wants it; the same where only pictures change.
Json controlled(Json script, const Control& control);

/// Which frame of the condition is shown at each place. `apex`: of the frames, the one farthest from the first.
std::vector<int> frame_order(const Control& control, int frames, int apex, unsigned seed);

}  // namespace risorius::design
