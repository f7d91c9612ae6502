// Action units of the Facial Action Coding System and expressions made of them: which muscles, jaw, eyes and head
// movement each stands for. Tables: rigs/standard/facs.json and expressions.json.
//
// A unit restricted to one side keeps the muscles and eye of that side and half of everything that has no sides, so that
// left and right together are the whole unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/channels.h"

namespace risorius::track {

struct MuscleShare {
    std::string muscle;
    std::optional<Side> side;  ///< none: both
    double weight = 0;         ///< excitation at full intensity, ratio
};

/// Movement of the jaw at full intensity; unset where a table says nothing about it.
struct JawShare {
    std::optional<double> open;  ///< ratio of the opening range
    std::optional<double> protrude_mm;
    std::optional<double> lateral_mm;  ///< > 0 to the subject's left
};

struct ActionUnit {
    std::string id;      ///< "AU12", "AU30.l"
    std::string name;    ///< "Lip corner puller"
    bool sided = false;  ///< may be restricted with .l or .r
    std::vector<MuscleShare> muscles;
    KinematicValues kinematic{};
    std::string unsupported;  ///< what a face would need for this unit, when this one cannot do it
    std::vector<std::pair<std::string, Vec3>>
        landmark_targets_mm;  ///< left or midline landmark -> displacement
};

/// A unit in a list, with how much of it.
struct UnitUse {
    std::string unit;  ///< id in FacsTable::units
    std::optional<Side> side;
    double value = 1;  ///< intensity, [0, 1]
};

/// One of the 52 blend shapes of ARKit face tracking, or a mouth shape of speech. Muscles, jaw and tongue given here replace
/// what the units give.
struct ArkitShape {
    std::string name;
    std::vector<UnitUse> units;
    std::vector<MuscleShare> muscles;
    JawShare jaw;
    std::optional<double> tongue_out_mm, tongue_up;  ///< up: ratio, [-1, 1]
};

/// What turns the millimetres of the tables into the ratios of the kinematic channels.
struct FacsRanges {
    double jaw_forward_mm = 9;
    double jaw_side_mm = 8;
    double tongue_out_mm = 45;
};

struct FacsTable {
    FacsRanges ranges;
    std::vector<ActionUnit> units;
    std::vector<ArkitShape> arkit;
    std::vector<ArkitShape> visemes;                      ///< none in rigs older than they are
    const ActionUnit* find(const std::string& id) const;  ///< null when unknown
    const ArkitShape* find_arkit(const std::string& name) const;  ///< null when unknown
};

/// Throws Error on muscles the rig does not have, units it does not know and weights outside the muscle's range.
FacsTable read_facs(const JsonCursor& json, const ChannelTable& channels);

struct ExpressionUnit {
    UnitUse use;
    double delay =
        0;  ///< how much later than the first unit it sets in, ratio of the onset, [0, 0.9]
};

struct Expression {
    std::string name;
    double onset_s = 0.5;  ///< usual durations, for scripts that give none
    double hold_s = 1.0;
    double offset_s = 0.8;
    std::vector<ExpressionUnit> units;
};

struct Expressions {
    std::vector<Expression> list;
    const Expression* find(const std::string& name) const;  ///< null when unknown
};

Expressions read_expressions(const JsonCursor& json, const FacsTable& facs);

/// What a source at full value adds to the drive.
struct Expansion {
    Eigen::VectorXd excitation;  ///< per column
    KinematicValues kinematic{};

    static Expansion none(const ChannelTable& channels);
    void add(const Expansion& part, double weight);
};

Expansion expand(const MuscleShare& share, const ChannelTable& channels);
Expansion expand(const ActionUnit& unit, std::optional<Side> side, const ChannelTable& channels);
Expansion expand(const ArkitShape& shape, const FacsTable& facs, const ChannelTable& channels);

/// "zygomaticus_major.l" as a share of weight 1. Throws at `place` for an unknown muscle or a side it does not have.
MuscleShare muscle_named(const JsonCursor& place, const std::string& name,
                         const ChannelTable& channels);

/// "AU" and a number, whether or not a table has it.
bool is_unit_number(std::string_view name);

/// "AU12.l" as a use of value 1. Throws at `place` for a unit that is unknown, has no sides, or cannot be moved by a rig.
UnitUse unit_named(const JsonCursor& place, const std::string& name, const FacsTable& facs);

}  // namespace risorius::track
