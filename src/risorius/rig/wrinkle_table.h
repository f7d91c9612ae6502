// SPDX-License-Identifier: MIT
/// \file
/// The lines of expression of the skin in landmark terms: where each set of lines lies, how far apart they are, which muscles fold them.
///
/// Lengths are in mm of the atlas head and scale with the head. Landmarks are those of the left side; a pattern of each side
/// takes their mirror images on the right. Source: rigs/standard/wrinkles.json.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::rig {

inline constexpr const char* kWrinkleFile = "wrinkles.json";  ///< of the standard anatomy

/// One end of a smooth step: fraction * base + each of `plus_mm`, added in this order.
struct WrinkleBound {
    std::string landmark;  ///< the base is a coordinate of it; empty: none
    std::string less;      ///< the base is |landmark - less| if it is given
    int crease_end =
        -1;        ///< the base is a coordinate of the first (0) or last (1) point of the crease
    int axis = 1;  ///< 0 outwards (x), 1 up (y)
    double fraction = 1.0;             ///< of the base
    std::vector<double> plus_mm = {};  ///< an angle in rad where the factor is one
};

/// A smooth step between 0 and 1 of a quantity of a point of the skin.
struct WrinkleFactor {
    enum class Of {
        kHeight,       ///< y
        kOutward,      ///< x, positive on the side of the pattern
        kFromMiddle,   ///< |x|
        kOverLine,     ///< height over a line through landmarks, seen from the front
        kUnderLine,    ///< the same, downwards
        kFromCrease,   ///< distance from the crease of the pattern
        kFromPoint,    ///< distance from a landmark
        kBeyondPoint,  ///< how far it lies outwards of a landmark
        kAroundPoint,  ///< distance from a landmark as seen from the front, with heights stretched
        kTurnAbout     ///< angle up or down from the outward direction about a landmark, rad
    };
    Of of = Of::kHeight;
    std::vector<std::string> line = {};  ///< landmarks from the left to the middle
    std::string point;                   ///< a landmark
    double stretch = 1.0;                ///< kAroundPoint: of heights
    double behind_mm = 0.0;  ///< kTurnAbout: how far the centre lies inwards of the landmark
    bool falls = false;      ///< from 1 to 0 instead of 0 to 1
    WrinkleBound from, to;
};

/// A muscle that folds the lines. 1: pulls across them from its origin to its insertion, -1: the other way, 0: not that side.
struct WrinkleFibres {
    std::string muscle;
    double left = 1, right = 1;
};

/// A point of a crease.
struct CreasePoint {
    std::string landmark;
    Vec3 offset_mm = Vec3::Zero();  ///< x outwards
};

/// One set of lines.
struct WrinklePattern {
    std::string name;
    bool each_side = false;    ///< once on the left and once on the right, mirrored
    bool aged = false;         ///< old skin only: the fraction grows with age
    int slot = 0;              ///< patterns that overlap have different slots, 0..2
    double wavelength_mm = 0;  ///< distance of the lines
    double fraction =
        1;  ///< of the depth that would keep all length; the rest thickens the skin, 0..1
    double permanence = 0;      ///< of the depth that stays in old skin at rest, 0..1
    double jitter = 0.16;       ///< random shift of the lines, wavelengths
    double jitter_spacing = 3;  ///< of its random values, wavelengths
    std::string
        anchor;  ///< landmark where the phase is `anchor_phase`; empty: the origin of the head
    double anchor_phase = 0;    ///< wavelengths; 0 is a valley
    bool along_fibres = false;  ///< the lines run along the fibres instead of across
    std::vector<WrinkleFibres> fibres = {};
    std::vector<CreasePoint> crease = {};  ///< instead of fibres: the line itself
    bool front_only = true;                ///< 0 behind the plane of the ears
    double min_outward_mm = -1e9;          ///< 0 nearer to the middle than this
    std::vector<WrinkleFactor> window =
        {};  ///< the pattern lies where the product of these is above 0
};

/// `known`: the ids of the atlas' landmarks. Throws Error on an unknown key, an unknown landmark or a value out of range.
std::vector<WrinklePattern> read_wrinkles(JsonCursor json, const std::vector<std::string>& known);

}  // namespace risorius::rig
