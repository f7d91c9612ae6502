// SPDX-License-Identifier: MIT
#include "risorius/track/facs.h"

#include "risorius/core/known_names.h"

namespace risorius::track {

namespace {

double& value(KinematicValues& values, Kinematic k) { return values[static_cast<std::size_t>(k)]; }

MuscleFraction read_fraction(const JsonCursor& json, const std::string& name,
                             const ChannelTable& channels) {
    MuscleFraction fraction = muscle_named(json, name, channels);
    fraction.weight = json.number({channels.find(fraction.muscle)->min, 1.0});
    return fraction;
}

std::vector<MuscleFraction> read_shares(const JsonCursor& json, const ChannelTable& channels) {
    std::vector<MuscleFraction> fractions;
    for (const std::string& name : json.keys())
        fractions.push_back(read_fraction(json.at(name), name, channels));
    return fractions;
}

double read_within(const JsonCursor& json, Kinematic k) {
    const KinematicChannel& channel = kinematic_channels()[static_cast<std::size_t>(k)];
    return json.number({channel.min, channel.max});
}

JawFraction read_jaw(const JsonCursor& json, const FacsRanges& ranges) {
    json.allow_keys({"open", "protrude_mm", "lateral_mm"});
    JawFraction jaw;
    if (const auto v = json.find("open")) jaw.open = read_within(*v, Kinematic::kJawOpen);
    if (const auto v = json.find("protrude_mm"))
        jaw.protrude_mm = v->number({0, ranges.jaw_forward_mm});
    if (const auto v = json.find("lateral_mm"))
        jaw.lateral_mm = v->number({-ranges.jaw_side_mm, ranges.jaw_side_mm});
    return jaw;
}

void apply_jaw(const JawFraction& jaw, const FacsRanges& ranges, KinematicValues& values) {
    if (jaw.open) value(values, Kinematic::kJawOpen) = *jaw.open;
    if (jaw.protrude_mm)
        value(values, Kinematic::kJawForward) = *jaw.protrude_mm / ranges.jaw_forward_mm;
    if (jaw.lateral_mm) value(values, Kinematic::kJawSide) = *jaw.lateral_mm / ranges.jaw_side_mm;
}

void read_head(const JsonCursor& json, KinematicValues& values) {
    json.allow_keys({"yaw_deg", "pitch_deg", "roll_deg", "forward_mm"});
    const std::pair<std::string_view, Kinematic> fields[] = {
        {"yaw_deg", Kinematic::kHeadYaw},
        {"pitch_deg", Kinematic::kHeadPitch},
        {"roll_deg", Kinematic::kHeadRoll},
        {"forward_mm", Kinematic::kHeadForward}};
    for (const auto& [key, k] : fields)
        if (const auto v = json.find(key)) value(values, k) = read_within(*v, k);
}

void read_eyes(const JsonCursor& json, KinematicValues& values) {
    json.allow_keys({"yaw_deg", "pitch_deg", "converge_deg", "diverge_deg"});
    double yaw = 0, pitch = 0, vergence = 0;
    if (const auto v = json.find("yaw_deg")) yaw = read_within(*v, Kinematic::kGazeYawLeft);
    if (const auto v = json.find("pitch_deg")) pitch = read_within(*v, Kinematic::kGazePitchLeft);
    if (const auto v = json.find("converge_deg")) vergence += v->number({0, 60});
    if (const auto v = json.find("diverge_deg")) vergence -= v->number({0, 20});
    // Vergence is the angle between the two lines of sight. Converging, the left eye turns to the subject's right.
    value(values, Kinematic::kGazeYawLeft) = yaw - vergence / 2;
    value(values, Kinematic::kGazeYawRight) = yaw + vergence / 2;
    value(values, Kinematic::kGazePitchLeft) = pitch;
    value(values, Kinematic::kGazePitchRight) = pitch;
}

ActionUnit read_unit(const JsonCursor& json, const std::string& id, const FacsRanges& ranges,
                     const ChannelTable& channels) {
    json.allow_keys({"name", "sided", "muscles", "jaw", "mouth_pressure_pa", "tongue_protrusion_mm",
                     "head", "eyes", "unsupported", "landmark_targets_mm", "activation_at",
                     "channels_at", "seen_with", "cues", "pictured_on"});
    ActionUnit unit;
    unit.id = id;
    unit.name = json.at("name").string();
    unit.sided = json.at("sided").boolean();
    if (unit.sided && split_side(id).side)
        json.at("sided").fail("false for a unit that names its side");
    if (const auto v = json.find("muscles")) unit.muscles = read_shares(*v, channels);
    if (const auto v = json.find("jaw")) apply_jaw(read_jaw(*v, ranges), ranges, unit.kinematic);
    if (const auto v = json.find("mouth_pressure_pa"))
        value(unit.kinematic, Kinematic::kMouthPressure) =
            read_within(*v, Kinematic::kMouthPressure);
    if (const auto v = json.find("tongue_protrusion_mm"))
        value(unit.kinematic, Kinematic::kTongueOut) =
            v->number({0, ranges.tongue_out_mm}) / ranges.tongue_out_mm;
    if (const auto v = json.find("head")) read_head(*v, unit.kinematic);
    if (const auto v = json.find("eyes")) read_eyes(*v, unit.kinematic);
    if (const auto v = json.find("activation_at")) unit.curve.muscles = read_intensity_curve(*v);
    if (const auto v = json.find("channels_at")) unit.curve.channels = read_intensity_curve(*v);
    if (const auto v = json.find("unsupported")) unit.unsupported = v->string();
    if (const auto v = json.find("cues")) unit.cues = v->string();
    if (const auto v = json.find("pictured_on")) {
        if (!unit.sided) v->fail("no side for a unit that cannot be restricted to one");
        unit.pictured_on = v->one_of({"l", "r"}) == "l" ? Side::kLeft : Side::kRight;
    }
    if (const auto v = json.find("landmark_targets_mm"))
        for (const std::string& landmark : v->keys())
            unit.landmark_targets_mm.emplace_back(landmark, v->at(landmark).vec3());
    return unit;
}

ArkitShape read_arkit_shape(const JsonCursor& json, const std::string& name, const FacsTable& facs,
                            const ChannelTable& channels) {
    json.allow_keys({"units", "muscles", "jaw", "tongue"});
    ArkitShape shape;
    shape.name = name;
    if (const auto units = json.find("units"))
        for (const std::string& unit : units->keys()) {
            UnitUse use = unit_named(units->at(unit), unit, facs);
            use.value = units->at(unit).number({0, 1});
            shape.units.push_back(std::move(use));
        }
    if (const auto v = json.find("muscles")) shape.muscles = read_shares(*v, channels);
    if (const auto v = json.find("jaw")) shape.jaw = read_jaw(*v, facs.ranges);
    if (const auto v = json.find("tongue")) {
        v->allow_keys({"out_mm", "up"});
        if (const auto out = v->find("out_mm"))
            shape.tongue_out_mm = out->number({0, facs.ranges.tongue_out_mm});
        if (const auto up = v->find("up")) shape.tongue_up = read_within(*up, Kinematic::kTongueUp);
    }
    return shape;
}

bool is_left_eye(Kinematic k) {
    return k == Kinematic::kGazeYawLeft || k == Kinematic::kGazePitchLeft;
}
bool is_right_eye(Kinematic k) {
    return k == Kinematic::kGazeYawRight || k == Kinematic::kGazePitchRight;
}

}  // namespace

const ActionUnit* FacsTable::find(const std::string& id) const {
    for (const ActionUnit& unit : units)
        if (unit.id == id) return &unit;
    return nullptr;
}

const ArkitShape* FacsTable::find_arkit(const std::string& name) const {
    for (const ArkitShape& shape : arkit)
        if (shape.name == name) return &shape;
    return nullptr;
}

const Manner* Expressions::find_manner(const std::string& name) const {
    for (const Manner& manner : manners)
        if (manner.name == name) return &manner;
    return nullptr;
}

const Expression* Expressions::find(const std::string& name) const {
    for (const Expression& expression : list)
        if (expression.name == name) return &expression;
    return nullptr;
}

MuscleFraction muscle_named(const JsonCursor& place, const std::string& name,
                            const ChannelTable& channels) {
    const SidedName sided = split_side(name);
    const MuscleChannel* muscle = channels.find(sided.id);
    if (!muscle) {
        std::vector<std::string> known;
        for (const MuscleChannel& m : channels.muscles) known.push_back(m.id);
        place.fail("a muscle of the rig" + did_you_mean(sided.id, known), in_quotes(name));
    }
    if (sided.side && !muscle->paired)
        place.fail(in_quotes(sided.id) + ", which has no sides", in_quotes(name));
    return {sided.id, sided.side, 1.0};
}

bool is_unit_number(std::string_view name) {
    return name.size() > 2 && name.starts_with("AU") &&
           name.find_first_not_of("0123456789", 2) == std::string_view::npos;
}

UnitUse unit_named(const JsonCursor& place, const std::string& name, const FacsTable& facs) {
    std::optional<Side> side;
    const ActionUnit* unit = facs.find(name);
    if (!unit) {
        const SidedName sided = split_side(name);
        unit = facs.find(sided.id);
        side = sided.side;
    }
    if (!unit) {
        // "AU30" alone: the message names the units with a side, which were probably meant.
        if (facs.find(name + ".l") && facs.find(name + ".r"))
            place.fail(in_quotes(name + ".l") + " or " + in_quotes(name + ".r"), in_quotes(name));
        // One unit number is not likely to be a misspelling of another.
        std::vector<std::string> known;
        if (!is_unit_number(split_side(name).id))
            for (const ActionUnit& u : facs.units) known.push_back(u.id);
        place.fail("an action unit of the rig's FACS table" + did_you_mean(name, known),
                   in_quotes(name));
    }
    if (side && !unit->sided)
        place.fail(in_quotes(unit->id) + ", which has no sides", in_quotes(name));
    if (!unit->unsupported.empty())
        place.fail("an action unit a rig can move",
                   in_quotes(name) + ", which needs " + unit->unsupported);
    return {unit->id, side, 1.0};
}

FacsTable read_facs(const JsonCursor& json, const ChannelTable& channels) {
    json.allow_keys({"source", "ranges", "action_units", "arkit", "visemes", "combinations"});
    FacsTable facs;
    if (const auto ranges = json.find("ranges")) {
        ranges->allow_keys({"jaw_forward_mm", "jaw_side_mm", "tongue_out_mm"});
        const auto read = [&](std::string_view key, double& range) {
            if (const auto v = ranges->find(key)) range = v->number({0.1, 1000});
        };
        read("jaw_forward_mm", facs.ranges.jaw_forward_mm);
        read("jaw_side_mm", facs.ranges.jaw_side_mm);
        read("tongue_out_mm", facs.ranges.tongue_out_mm);
    }
    const JsonCursor units = json.at("action_units");
    for (const std::string& id : units.keys())
        facs.units.push_back(read_unit(units.at(id), id, facs.ranges, channels));
    for (ActionUnit& unit : facs.units)
        if (const auto others = units.at(unit.id).find("seen_with"))
            for (const std::string& name : others->keys()) {
                UnitUse use = unit_named(others->at(name), name, facs);
                use.value = others->at(name).number({0, 1});
                unit.seen_with.push_back(std::move(use));
            }
    if (const auto combinations = json.find("combinations"))
        for (const JsonCursor& list : combinations->items()) {
            facs.combinations.emplace_back();
            for (const JsonCursor& unit : list.items()) {
                if (!facs.find(unit.string())) unit.fail("an action unit of this table");
                facs.combinations.back().push_back(unit.string());
            }
            if (facs.combinations.back().size() < 2) list.fail("two units or more");
        }
    if (const auto arkit = json.find("arkit"))
        for (const std::string& name : arkit->keys())
            facs.arkit.push_back(read_arkit_shape(arkit->at(name), name, facs, channels));
    if (const auto visemes = json.find("visemes"))
        for (const std::string& name : visemes->keys())
            facs.visemes.push_back(read_arkit_shape(visemes->at(name), name, facs, channels));
    return facs;
}

namespace {

ExpressionParts read_parts(const JsonCursor& entry, const FacsTable& facs,
                           const ChannelTable& channels) {
    ExpressionParts parts;
    const JsonCursor units = entry.at("units");
    for (const std::string& unit : units.keys()) {
        const JsonCursor part = units.at(unit);
        part.allow_keys({"value", "delay"});
        ExpressionUnit use{unit_named(part, unit, facs), 0};
        use.use.value = part.at("value").number({0, 1});
        // A delay as long as the onset would leave no time to move.
        if (const auto delay = part.find("delay")) use.delay = delay->number({0, 0.9});
        parts.units.push_back(std::move(use));
    }
    if (const auto muscles = entry.find("muscles"))
        for (const std::string& name : muscles->keys()) {
            MuscleFraction muscle = muscle_named(muscles->at(name), name, channels);
            muscle.weight = muscles->at(name).number({0, 1});
            parts.muscles.push_back(std::move(muscle));
        }
    return parts;
}

}  // namespace

const ExpressionVariant* Expression::find_variant(const std::string& variant) const {
    const auto found =
        std::find_if(variants.begin(), variants.end(),
                     [&](const ExpressionVariant& one) { return one.name == variant; });
    return found == variants.end() ? nullptr : &*found;
}

Expressions read_expressions(const JsonCursor& json, const FacsTable& facs,
                             const ChannelTable& channels) {
    json.allow_keys({"source", "expressions", "manners"});
    const JsonCursor table = json.at("expressions");
    Expressions expressions;
    for (const std::string& name : table.keys()) {
        const JsonCursor entry = table.at(name);
        entry.allow_keys(
            {"source", "onset_s", "hold_s", "offset_s", "units", "muscles", "variants"});
        Expression expression;
        expression.name = name;
        expression.onset_s = entry.at("onset_s").number({0, 60});
        expression.hold_s = entry.at("hold_s").number({0, 3600});
        expression.offset_s = entry.at("offset_s").number({0, 60});
        if (const auto source = entry.find("source")) expression.source = source->string();
        expression.parts = read_parts(entry, facs, channels);
        if (const auto variants = entry.find("variants"))
            for (const std::string& variant : variants->keys()) {
                const JsonCursor one = variants->at(variant);
                one.allow_keys({"source", "units", "muscles"});
                expression.variants.push_back(
                    {variant, one.at("source").string(), read_parts(one, facs, channels)});
            }
        expressions.list.push_back(std::move(expression));
    }
    if (const auto manners = json.find("manners"))
        for (const std::string& name : manners->keys()) {
            const JsonCursor entry = manners->at(name);
            expressions.manners.push_back(read_manner(entry, name));
            for (const auto& [expression, times] : expressions.manners.back().listed)
                if (!expressions.find(expression))
                    entry.at("expressions").at(expression).fail("the name of an expression");
        }
    return expressions;
}

IntensityCurve read_intensity_curve(const JsonCursor& json) {
    std::array<double, 3> at{};
    const std::vector<JsonCursor> given = json.items();
    if (given.size() != at.size()) json.fail("three activations", std::to_string(given.size()));
    double before = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        at[i] = given[i].number({0.001, 0.999});
        if (at[i] <= before) given[i].fail("more than " + format_number(before));
        before = at[i];
    }
    return IntensityCurve(at);
}

Expansion Expansion::none(const ChannelTable& channels) {
    Expansion expansion;
    expansion.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return expansion;
}

void Expansion::add(const Expansion& part, double weight) {
    excitation += weight * part.excitation;
    for (std::size_t k = 0; k < kinematic.size(); ++k) kinematic[k] += weight * part.kinematic[k];
}

void Expansion::add(const Expansion& part, const UnitCurves& curve, double intensity) {
    excitation += curve.muscles.activation(intensity) * part.excitation;
    const double jaw = curve.channels.activation(intensity);
    for (std::size_t k = 0; k < kinematic.size(); ++k)
        kinematic[k] +=
            (has_curve(static_cast<Kinematic>(k)) ? jaw : intensity) * part.kinematic[k];
}

Expansion expand(const MuscleFraction& fraction, const ChannelTable& channels) {
    Expansion expansion = Expansion::none(channels);
    for (Side side : {Side::kLeft, Side::kRight})
        if (!fraction.side || *fraction.side == side)
            expansion.excitation[channels.column(fraction.muscle, side)] = fraction.weight;
    return expansion;
}

Expansion expand(const ActionUnit& unit, std::optional<Side> side, const ChannelTable& channels) {
    Expansion expansion = Expansion::none(channels);
    for (const MuscleFraction& muscle : unit.muscles) {
        MuscleFraction fraction = muscle;
        const bool paired = channels.find(muscle.muscle)->paired;
        if (side && !paired) fraction.weight /= 2;
        if (side && paired && !fraction.side) fraction.side = side;
        expansion.add(expand(fraction, channels), 1.0);
    }
    for (int i = 0; i < kKinematicCount; ++i) {
        const auto k = static_cast<Kinematic>(i);
        double fraction = 1.0;
        if (side && (is_left_eye(k) || is_right_eye(k)))
            fraction = is_left_eye(k) == (*side == Side::kLeft) ? 1.0 : 0.0;
        else if (side)
            fraction = 0.5;
        value(expansion.kinematic, k) = fraction * unit.kinematic[static_cast<std::size_t>(i)];
    }
    return expansion;
}

Expansion expand(const ArkitShape& shape, const FacsTable& facs, const ChannelTable& channels) {
    Expansion expansion = Expansion::none(channels);
    for (const UnitUse& use : shape.units)
        expansion.add(expand(*facs.find(use.unit), use.side, channels), use.value);
    for (const MuscleFraction& fraction : shape.muscles)
        for (Side side : {Side::kLeft, Side::kRight})
            if (!fraction.side || *fraction.side == side)
                expansion.excitation[channels.column(fraction.muscle, side)] = fraction.weight;
    apply_jaw(shape.jaw, facs.ranges, expansion.kinematic);
    if (shape.tongue_out_mm)
        value(expansion.kinematic, Kinematic::kTongueOut) =
            *shape.tongue_out_mm / facs.ranges.tongue_out_mm;
    if (shape.tongue_up) value(expansion.kinematic, Kinematic::kTongueUp) = *shape.tongue_up;
    // Overlapping units may add up to more than a muscle can do.
    expansion.excitation = expansion.excitation.cwiseMax(channels.column_min()).cwiseMin(1.0);
    return expansion;
}

}  // namespace risorius::track
