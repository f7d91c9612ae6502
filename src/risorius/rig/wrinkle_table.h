// SPDX-License-Identifier: MIT
/// \file
/// The table of wrinkles: position and distance of each set of lines relative to landmarks, and the muscles that fold them.
///
/// Lengths are in mm of the atlas head and scale with the head. Landmarks are those of the left side; a pattern with `each_side`
/// uses their mirror images on the right. Source: rigs/standard/wrinkles.json.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::rig {

inline constexpr const char* kWrinkleFile = "wrinkles.json";  ///< a file of the standard anatomy

/// One end of the range of a smooth step: its value is fraction * base + the sum of `plus_mm`, added in this order.
struct WrinkleBound {
    std::string landmark;  ///< the base is a coordinate of this landmark; empty: none
    std::string less;      ///< if given, the base is |landmark - less|
    /// The base is a coordinate of the first (0) or last (1) point of the crease
    int crease_end = -1;
    int axis = 1;                      ///< 0 outwards (x), 1 up (y)
    double fraction = 1.0;             ///< factor of the base
    std::vector<double> plus_mm = {};  ///< for kTurnAbout an angle, rad
};

/// A factor 0..1 of the depth of wrinkles at a point of the skin: a smooth step of a quantity of the point between two bounds.
struct WrinkleFactor {
    enum class Of {
        kHeight,       ///< y
        kOutward,      ///< x, positive on the side of the pattern
        kFromMiddle,   ///< |x|
        kOverLine,     ///< height above a line through landmarks, seen from the front
        kUnderLine,    ///< the same, downwards
        kFromCrease,   ///< distance from the crease of the pattern
        kFromPoint,    ///< distance from a landmark
        kBeyondPoint,  ///< distance outwards from a landmark
        kAroundPoint,  ///< distance from a landmark as seen from the front, with heights stretched
        kTurnAbout     ///< angle up or down from the outward direction at a landmark, rad
    };
    Of of = Of::kHeight;
    std::vector<std::string> line = {};  ///< landmarks from the left to the midline
    std::string point;                   ///< a landmark
    double stretch = 1.0;                ///< kAroundPoint: factor of heights
    double behind_mm = 0.0;  ///< kTurnAbout: distance of the centre inwards from the landmark
    bool falls = false;      ///< goes from 1 to 0 instead of 0 to 1
    WrinkleBound from, to;
};

/// A muscle that folds the skin along the lines. `left` and `right`: 1 if the muscle pulls across the lines from its origin to
/// its insertion; -1 if it pulls in the opposite direction; 0 if it does not act on that side.
struct WrinkleFibres {
    std::string muscle;
    double left = 1, right = 1;
};

/// A point of a crease.
struct CreasePoint {
    std::string landmark;
    Vec3 offset_mm = Vec3::Zero();  ///< x outwards
};

/// Shortening at which lines begin unless the table says otherwise.
inline constexpr double kWrinkleOnset = 0.05;

/// One set of lines.
struct WrinklePattern {
    std::string name;
    bool each_side = false;  ///< exists on the left and, mirrored, on the right
    /// True: the lines exist only on old skin, and `fraction` grows with age
    bool aged = false;
    int slot = 0;              ///< overlapping patterns have different slots, 0..2
    double wavelength_mm = 0;  ///< distance between the lines
    /// Depth of the lines, 0..1: as a fraction of the depth at which the length of the skin would not change. The rest of the
    /// compression thickens the skin
    double fraction = 1;
    /// Shortening of the skin across the lines at which they begin, 0..0.5; a crease begins at 0.025 less
    double onset = kWrinkleOnset;
    double permanence = 0;      ///< fraction of the depth that remains in old skin at rest, 0..1
    double jitter = 0.16;       ///< random displacement of the lines, wavelengths
    double jitter_spacing = 3;  ///< spacing of the random values, wavelengths
    /// Landmark at which the phase is `anchor_phase`; empty: the origin of the head
    std::string anchor;
    double anchor_phase = 0;    ///< wavelengths; 0 is a valley
    bool along_fibres = false;  ///< the lines run along the fibres instead of across them
    std::vector<WrinkleFibres> fibres = {};
    /// The points of the line itself, for a pattern without fibres
    std::vector<CreasePoint> crease = {};
    /// True: there are no lines behind the plane of the ears
    bool front_only = true;
    double min_outward_mm = -1e9;  ///< there are no lines nearer to the midplane than this
    /// The pattern lies where the product of these factors is positive
    std::vector<WrinkleFactor> window = {};
};

/// Reads a table. `known`: ids of the landmarks of the atlas. Throws Error for an unknown key, an unknown landmark or a value out
/// of range.
std::vector<WrinklePattern> read_wrinkles(JsonCursor json, const std::vector<std::string>& known);

}  // namespace risorius::rig
