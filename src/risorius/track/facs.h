// SPDX-License-Identifier: MIT
/// \file
/// Action units of the Facial Action Coding System, and expressions made of them: the muscles, jaw, eye and head movements of
/// each. The tables are rigs/standard/facs.json and expressions.json.
///
/// A unit that is restricted to one side keeps the muscles and the eye of that side, and half of everything that has no sides.
/// The left and the right unit add up to the whole unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/channels.h"
#include "risorius/track/detail/manner.h"
#include "risorius/track/intensity_curve.h"

namespace risorius::track {

/// The contribution of a muscle to an action unit.
struct MuscleFraction {
    std::string muscle;
    std::optional<Side> side;  ///< none: both sides
    double weight = 0;         ///< excitation at full intensity
};

/// Movement of the jaw at full intensity. Fields are unset where the table does not give them.
struct JawFraction {
    std::optional<double> open;  ///< fraction of the opening range
    std::optional<double> protrude_mm;
    std::optional<double> lateral_mm;  ///< > 0 to the subject's left
};

/// An action unit and its intensity.
struct UnitUse {
    std::string unit;  ///< id in FacsTable::units
    std::optional<Side> side;
    double value = 1;  ///< intensity, [0, 1]
};

/// A row of the table of units.
struct ActionUnit {
    std::string id;      ///< "AU12", "AU30.l"
    std::string name;    ///< "Lip corner puller"
    bool sided = false;  ///< may be restricted to a side with .l or .r
    std::vector<MuscleFraction> muscles;
    KinematicValues kinematic{};
    UnitCurves curve;  ///< from the intensity to the activation of its muscles and its channels
    std::string unsupported;  ///< why this face cannot show the unit; empty when it can
    std::string cues;         ///< what a coder looks for, in sentences; empty in older tables
    std::optional<Side>
        pictured_on;  ///< the side that pictures for coders show alone, as of a wink
    /// Displacements that the unit should cause: a landmark on the left side or the midline, and its displacement.
    std::vector<std::pair<std::string, Vec3>> landmark_targets_mm;
    /// Units without which it is not seen, as AU8 is not between closed lips. The targets begin at their pose.
    std::vector<UnitUse> seen_with;
};

/// One of the 52 blend shapes of ARKit face tracking, or a mouth shape of speech. Muscles, jaw and tongue given here replace
/// those of the units.
struct ArkitShape {
    std::string name;
    std::vector<UnitUse> units;
    std::vector<MuscleFraction> muscles;
    JawFraction jaw;
    std::optional<double> tongue_out_mm, tongue_up;  ///< tongue_up: curl of the tip, [-1, 1]
};

/// Ranges that convert lengths in the tables, mm, to fractions of the kinematic channels.
struct FacsRanges {
    double jaw_forward_mm = 9;
    double jaw_side_mm = 8;
    double tongue_out_mm = 45;
};

/// Everything that facs.json defines.
struct FacsTable {
    FacsRanges ranges;
    std::vector<ActionUnit> units;
    std::vector<std::vector<std::string>> combinations;  ///< units that often occur together
    std::vector<ArkitShape> arkit;
    std::vector<ArkitShape> visemes;                      ///< empty in rigs of older versions
    const ActionUnit* find(const std::string& id) const;  ///< null when unknown
    const ArkitShape* find_arkit(const std::string& name) const;  ///< null when unknown
};

/// Throws Error for muscles that the rig does not have, unknown units, and weights outside the muscle's range.
FacsTable read_facs(const JsonCursor& json, const ChannelTable& channels);

/// Reads three activations. Throws Error for others than three numbers that increase within (0, 1).
IntensityCurve read_intensity_curve(const JsonCursor& json);

/// A unit of an expression, with its delay.
struct ExpressionUnit {
    UnitUse use;
    /// Delay of the start of the unit behind that of the first unit, as a fraction of the onset, [0, 0.9]
    double delay = 0;
};

/// What an expression consists of at intensity 1.
struct ExpressionParts {
    std::vector<ExpressionUnit> units;
    /// Muscles that contract more than the units ask for. They start with the first unit and have no FACS code of their own.
    std::vector<MuscleFraction> muscles;
};

/// Another form of an expression, for instance the one that a study observed.
struct ExpressionVariant {
    std::string name;
    std::string source;  ///< who published it
    ExpressionParts parts;
};

/// An expression: a named set of units, with the usual durations of onset, hold and offset.
struct Expression {
    std::string name;
    std::string source;    ///< who published its units; empty in tables of older versions
    double onset_s = 0.5;  ///< usual durations, for scripts that give none
    double hold_s = 1.0;
    double offset_s = 0.8;
    ExpressionParts parts;
    std::vector<ExpressionVariant> variants;
    const ExpressionVariant* find_variant(const std::string& variant) const;  ///< null when unknown
};

struct Expressions {
    std::vector<Expression> list;
    std::vector<Manner> manners;                               ///< none in tables of older versions
    const Expression* find(const std::string& name) const;     ///< null when unknown
    const Manner* find_manner(const std::string& name) const;  ///< null when unknown
};

/// Reads expressions.json. Throws Error for unknown units, muscles and expressions, and for values outside their ranges.
Expressions read_expressions(const JsonCursor& json, const FacsTable& facs,
                             const ChannelTable& channels);

/// What a source (muscle, action unit or shape) with value 1 adds to the drive.
struct Expansion {
    Eigen::VectorXd excitation;  ///< per column
    KinematicValues kinematic{};

    static Expansion none(const ChannelTable& channels);
    void add(const Expansion& part, double weight);
    /// Adds a part at an intensity: muscles, jaw and pressure by their curves, the other channels by the intensity.
    void add(const Expansion& part, const UnitCurves& curve, double intensity);
};

/// The curve of muscles that an expression adds to its units: the mean response of the units of the standard table.
inline const UnitCurves& curve_of_added_muscles() {
    static const UnitCurves curve{IntensityCurve({0.125, 0.29, 0.54}), {}};
    return curve;
}

Expansion expand(const MuscleFraction& fraction, const ChannelTable& channels);
Expansion expand(const ActionUnit& unit, std::optional<Side> side, const ChannelTable& channels);
Expansion expand(const ArkitShape& shape, const FacsTable& facs, const ChannelTable& channels);

/// Returns the muscle with a name such as "zygomaticus_major.l", with weight 1. Throws Error at `place` for an unknown muscle, or
/// for a side that it does not have.
MuscleFraction muscle_named(const JsonCursor& place, const std::string& name,
                            const ChannelTable& channels);

/// Returns whether a name is "AU" followed by a number, whether or not a table has that unit.
bool is_unit_number(std::string_view name);

/// Returns the unit with a name such as "AU12.l", with value 1. Throws Error at `place` for a unit that is unknown, that has no
/// sides, or that the rig cannot show.
UnitUse unit_named(const JsonCursor& place, const std::string& name, const FacsTable& facs);

}  // namespace risorius::track
