// SPDX-License-Identifier: MIT
#include "risorius/track/script.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "risorius/core/existing_file.h"
#include "risorius/core/known_names.h"
#include "risorius/track/detail/emg_source.h"
#include "risorius/track/detail/script_limits.h"
#include "risorius/track/timeline.h"

namespace risorius::track {

namespace {

constexpr double kMaxAsymmetry = 0.5;
// Schmidt et al. 2006: smiles of the two sides begin less than 40 ms apart.
constexpr double kLatestSide_s = 0.040;
constexpr double kBlinkApart_s = 0.3;  // minimum distance of idle blinks from blinks in the script

/// Resolves the names in a script against a rig.
class Reader {
  public:
    Reader(const ChannelTable& channels, const FacsTable& facs, const Expressions& expressions)
        : channels_(channels), facs_(facs), expressions_(expressions) {}

    ChannelTrack channel(const JsonCursor& json, const std::string& name) const {
        json.allow_keys({"keys", "interpolation", "activation"});
        ChannelTrack track;
        track.name = name;
        Range range{0, 1};
        bool has_muscles = false;
        track.drives = resolve(json, name, range, has_muscles, track.curve);

        if (const auto v = json.find("activation")) {
            track.activation = v->boolean();
            if (track.activation && !has_muscles)
                v->fail("\"activation\" on a channel that moves muscles only");
        }
        if (const auto v = json.find("interpolation")) {
            const std::string text = v->one_of({"step", "linear", "smooth"});
            track.interpolation = text == "step"     ? Interpolation::kStep
                                  : text == "linear" ? Interpolation::kLinear
                                                     : Interpolation::kSmooth;
        }
        track.keys = read_keys(json.at("keys"), range);
        return track;
    }

    ExpressionEvent expression(const JsonCursor& json, const ScriptHeader& header,
                               int number) const {
        const double duration_s = header.duration_s;
        json.allow_keys({"expression", "variant", "intensity", "start_s", "onset_s", "hold_s",
                         "offset_s", "side", "asymmetry", "manner"});
        const Expression& usual = expression_named(json.at("expression"));
        const ExpressionParts& parts = parts_of(usual, json);
        ExpressionEvent event;
        event.expression = usual.name;
        if (const auto variant = json.find("variant")) event.variant = variant->string();
        event.intensity = optional_number(json, "intensity", 1, {0, 1});
        event.start_s = json.at("start_s").number({0, duration_s});
        const ExpressionTimes times = times_of(usual, json);
        event.onset_s = optional_number(json, "onset_s", times.onset_s, {0, 60});
        event.hold_s = optional_number(json, "hold_s", times.hold_s, {0, kLongest_s});
        event.offset_s = optional_number(json, "offset_s", times.offset_s, {0, 60});
        event.side = read_side(json);
        event.asymmetry = optional_number(json, "asymmetry", 0, {0, kMaxAsymmetry});
        const bool even = event.asymmetry == 0;
        Side weaker = Side::kLeft;
        double chance = 0;
        if (!even) {
            // Random numbers are drawn in a way that is the same for every standard library.
            std::seed_seq seed{header.seed, number};
            std::mt19937 random(seed);
            weaker = random() % 2 ? Side::kLeft : Side::kRight;
            chance = (random() >> 8) * 0x1p-24;
        }
        const double lag = event.onset_s > 0 ? kLatestSide_s * chance / event.onset_s : 0.0;
        const double least = 1 - event.asymmetry * (0.5 + 0.5 * chance);
        // Adds a part on the side that it has, or both sides of it apart when they differ.
        const auto add =
            [&](std::optional<Side> side, bool sided, double delay,
                const std::function<ExpressionEvent::Part(std::optional<Side>, double)>& make) {
                const auto add_side = [&](std::optional<Side> on, double fraction, double later) {
                    event.parts.push_back(make(on, fraction));
                    event.parts.back().delay = std::min(later, 0.9);
                };
                if (even || side || !sided) {
                    add_side(side, 1, delay);
                    return;
                }
                for (const Side one : {Side::kLeft, Side::kRight})
                    if (one == weaker)
                        add_side(one, least, delay + lag);
                    else
                        add_side(one, 1, delay);
            };
        for (const ExpressionUnit& part : parts.units) {
            const ActionUnit& unit = *facs_.find(part.use.unit);
            // A unit that is one-sided in the table moves to the side that the event asks for.
            add(event.side ? event.side : part.use.side, unit.sided, part.delay,
                [&](std::optional<Side> on, double fraction) {
                    const double value = fraction * part.use.value * event.intensity;
                    return ExpressionEvent::Part{expand(unit, on, channels_),
                                                 unit.curve,
                                                 value,
                                                 0,
                                                 {part.use.unit, on, value}};
                });
        }
        for (const MuscleFraction& muscle : parts.muscles) {
            const bool paired = channels_.find(muscle.muscle)->paired;
            add(paired && event.side ? event.side : muscle.side, paired, 0,
                [&](std::optional<Side> on, double fraction) {
                    return ExpressionEvent::Part{
                        expand(MuscleFraction{muscle.muscle, on, muscle.weight}, channels_),
                        curve_of_added_muscles(),
                        fraction * event.intensity,
                        0,
                        {"", on, 0}};
                });
        }
        return event;
    }

    BlinkEvent blink(const JsonCursor& json, double duration_s) const {
        json.allow_keys({"blink", "start_s"});
        const JsonCursor options = json.at("blink");
        options.allow_keys({"duration_s", "intensity", "side"});
        BlinkEvent event;
        event.start_s = json.at("start_s").number({0, duration_s});
        event.duration_s =
            optional_number(options, "duration_s", event.duration_s, {kShortestBlink_s, 2});
        event.intensity = optional_number(options, "intensity", 1, {0, 1});
        event.side = read_side(options);
        close_lids(json.at("blink"), event);
        return event;
    }

    IdleEvent idle(const JsonCursor& json, const ScriptHeader& header, int number) const {
        json.allow_keys({"idle", "start_s", "end_s", "duration_s"});
        IdleEvent event;
        event.options = read_idle_options(json.at("idle"));
        event.seed = header.seed;
        event.number = number;
        event.start_s = optional_number(json, "start_s", 0, {0, header.duration_s});
        event.end_s = header.duration_s;
        if (json.has("end_s") && json.has("duration_s"))
            json.fail("either \"end_s\" or \"duration_s\"", "both");
        if (const auto v = json.find("end_s")) event.end_s = v->number({event.start_s, kLongest_s});
        if (const auto v = json.find("duration_s"))
            event.end_s = event.start_s + v->number({0, kLongest_s});
        return event;
    }

    /// Adds the blinks of an idle face, except those that coincide with blinks in the script.
    void add_idle_blinks(const JsonCursor& json, const IdleEvent& idle,
                         std::vector<BlinkEvent>& blinks) const {
        const std::vector<BlinkEvent> written = blinks;
        for (const IdleBlink& blink : idle_blinks(idle)) {
            BlinkEvent event;
            event.start_s = blink.start_s;
            event.intensity = blink.intensity;
            const double end_s = event.start_s + event.duration_s;
            if (std::any_of(written.begin(), written.end(), [&](const BlinkEvent& other) {
                    return other.start_s < end_s + kBlinkApart_s &&
                           event.start_s < other.start_s + other.duration_s + kBlinkApart_s;
                }))
                continue;
            close_lids(json.at("idle"), event);
            blinks.push_back(std::move(event));
        }
    }

  private:
    const Expression& expression_named(const JsonCursor& name) const {
        if (const Expression* found = expressions_.find(name.string())) return *found;
        std::vector<std::string_view> known;
        for (const Expression& e : expressions_.list) known.push_back(e.name);
        const std::string near = nearest_name(name.string(), known);
        std::string expected = near.empty() ? "one of"
                                            : "an expression of the rig (did you mean " +
                                                  risorius::in_quotes(near) + "?)";
        if (near.empty())
            for (std::string_view k : known) expected += " " + in_quotes(std::string(k));
        name.fail(expected);
    }

    /// The parts of the expression, or of the variant that the event names.
    static const ExpressionParts& parts_of(const Expression& expression, const JsonCursor& json) {
        const auto variant = json.find("variant");
        if (!variant) return expression.parts;
        if (const ExpressionVariant* found = expression.find_variant(variant->string()))
            return found->parts;
        std::string expected = "a variant of " + risorius::in_quotes(expression.name) + ", ";
        for (std::size_t i = 0; i < expression.variants.size(); ++i)
            expected +=
                (i > 0 ? ", " : "one of ") + risorius::in_quotes(expression.variants[i].name);
        if (expression.variants.empty()) expected += "which has none";
        variant->fail(expected);
    }

    /// The usual times of the expression, in the manner that the event names.
    ExpressionTimes times_of(const Expression& expression, const JsonCursor& json) const {
        const ExpressionTimes usual{expression.onset_s, expression.hold_s, expression.offset_s};
        const auto manner = json.find("manner");
        if (!manner) return usual;
        if (const Manner* found = expressions_.find_manner(manner->string()))
            return found->times(expression.name, usual);
        std::string expected =
            expressions_.manners.empty() ? "a rig whose expressions table has manners" : "one of";
        for (const Manner& known : expressions_.manners) expected += " " + in_quotes(known.name);
        manner->fail(expected);
    }

    void close_lids(const JsonCursor& place, BlinkEvent& event) const {
        const ActionUnit* unit = facs_.find("AU45");
        if (!unit) place.fail("a rig whose facs table has AU45", "none");
        event.drives = Expansion::none(channels_);
        event.drives.add(expand(*unit, event.side, channels_), event.intensity);
    }

    /// What a shape of ARKit stands for. A shape of one unit has the curve of that unit, others the mean of the units.
    Expansion shape_drives(const ArkitShape& shape, UnitCurves& curve) const {
        const bool is_unit = shape.units.size() == 1 && shape.muscles.empty();
        curve = is_unit ? facs_.find(shape.units.front().unit)->curve : curve_of_added_muscles();
        return expand(shape, facs_, channels_);
    }

    /// Also returns the range of the channel's values, whether it may set activation (all but kinematic channels), and the curve
    /// of an action unit or a shape.
    Expansion resolve(const JsonCursor& json, const std::string& name, Range& range,
                      bool& has_muscles, UnitCurves& curve) const {
        const std::vector<Kinematic> kinematic = kinematic_named(name);
        if (!kinematic.empty()) {
            Expansion drives = Expansion::none(channels_);
            for (Kinematic k : kinematic) {
                drives.kinematic[static_cast<std::size_t>(k)] = 1;
                const KinematicChannel& channel = kinematic_channels()[static_cast<std::size_t>(k)];
                range = {channel.min, channel.max};
            }
            return drives;
        }
        has_muscles = true;
        if (const ArkitShape* shape = facs_.find_arkit(name)) return shape_drives(*shape, curve);
        const std::string id = split_side(name).id;
        if (const MuscleChannel* muscle = channels_.find(id)) {
            range = {muscle->min, 1};
            return expand(muscle_named(json, name, channels_), channels_);
        }
        if (facs_.find(id) || facs_.find(name) || facs_.find(id + ".l") || is_unit_number(id)) {
            const UnitUse use = unit_named(json, name, facs_);
            curve = facs_.find(use.unit)->curve;
            return expand(*facs_.find(use.unit), use.side, channels_);
        }
        std::vector<std::string_view> known;
        for (const MuscleChannel& muscle : channels_.muscles) known.push_back(muscle.id);
        for (const ActionUnit& unit : facs_.units) known.push_back(unit.id);
        for (const ArkitShape& shape : facs_.arkit) known.push_back(shape.name);
        for (const KinematicChannel& channel : kinematic_channels())
            known.push_back(channel.name.ends_with(".l") || channel.name.ends_with(".r")
                                ? channel.name.substr(0, channel.name.size() - 2)
                                : channel.name);
        std::string near = nearest_name(id, known);
        for (const std::string side : {".left", ".right"})
            if (name.ends_with(side))
                if (const std::string whole = name.substr(0, name.size() - side.size());
                    channels_.find(whole) || facs_.find(whole))
                    near = whole + side.substr(0, 2);
        json.fail("a muscle, action unit, ARKit shape or kinematic channel of the rig" +
                      (near.empty() ? " (`risorius info` lists them)"
                                    : " (did you mean " + risorius::in_quotes(near) + "?)"),
                  in_quotes(name));
    }

    static std::vector<Key> read_keys(const JsonCursor& json, Range range) {
        std::vector<Key> keys;
        for (const JsonCursor& item : json.items()) {
            if (!item.is_array() || item.json().size() != 2) item.fail("a key [time_s, value]");
            const std::vector<JsonCursor> pair = item.items();
            const double time_s = pair[0].number({0, kLongest_s});
            if (!keys.empty() && time_s <= keys.back().time_s)
                pair[0].fail("a time after " + format_number(keys.back().time_s) + " s");
            keys.push_back({time_s, pair[1].number(range)});
        }
        if (keys.empty()) json.fail("at least one key [time_s, value]");
        return keys;
    }

    static double optional_number(const JsonCursor& json, std::string_view key, double otherwise,
                                  Range range) {
        const auto value = json.find(key);
        return value ? value->number(range) : otherwise;
    }

    static std::optional<Side> read_side(const JsonCursor& json) {
        const auto side = json.find("side");
        if (!side) return std::nullopt;
        return side->one_of({"l", "r"}) == "l" ? Side::kLeft : Side::kRight;
    }

    const ChannelTable& channels_;
    const FacsTable& facs_;
    const Expressions& expressions_;
};

// In a render each event of an expression takes some 40 kB of memory, and each step of the simulation asks every event and pull.
constexpr std::size_t kMostEvents = 10000, kMostIdleEvents = 100, kMostPulls = 1000;

void require_at_most(std::size_t most, const char* what, const JsonCursor& list) {
    const std::size_t count = list.items().size();
    if (count > most)
        list.fail("at most " + std::to_string(most) + " " + what, std::to_string(count));
}

}  // namespace

ScriptDescription read_script(const std::filesystem::path& file, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions) {
    return read_script(JsonCursor::read_file(file), channels, facs, expressions);
}

namespace {

constexpr const char* kSideNames[] = {"left", "right"};

// Reads the weakness of "left", "right", or a muscle with or without a side.
void read_weakness(const JsonCursor& json, const std::string& name, const ChannelTable& channels,
                   Eigen::VectorXd& weakness) {
    const double value = json.number({0, 1});
    const auto set = [&](const std::string& id, Side side) {
        double& one = weakness[channels.column(id, side)];
        one = std::max(one, value);
    };
    for (const Side side : {Side::kLeft, Side::kRight})
        if (name == kSideNames[side == Side::kLeft ? 0 : 1]) {
            for (const MuscleChannel& muscle : channels.muscles)
                if (channels.column(muscle.id, Side::kLeft) !=
                    channels.column(muscle.id, Side::kRight))
                    set(muscle.id, side);
            return;
        }
    const SidedName sided = split_side(name);
    if (!channels.find(sided.id)) {
        std::vector<std::string> known{"left", "right"};
        for (const MuscleChannel& muscle : channels.muscles) known.push_back(muscle.id);
        json.fail("a muscle of the rig, with or without .l or .r, \"left\" or \"right\"" +
                      risorius::did_you_mean(sided.id, known),
                  in_quotes(name));
    }
    for (const Side side : {Side::kLeft, Side::kRight})
        if (!sided.side || *sided.side == side) set(sided.id, side);
}

}  // namespace

ScriptDescription read_script(const JsonCursor& json, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions) {
    ScriptDescription script;
    script.header = read_script_header(json);
    if (const auto weakness = json.find("weakness")) {
        script.weakness = Eigen::VectorXd::Zero(channels.column_count());
        for (const std::string& name : weakness->keys())
            read_weakness(weakness->at(name), name, channels, script.weakness);
    }
    if (const auto late = json.find("late_s")) {
        late->allow_keys({kSideNames[0], kSideNames[1]});
        for (std::size_t side = 0; side < 2; ++side)
            if (const auto v = late->find(kSideNames[side]))
                script.late_s[side] = v->number({0, 10});
    }
    if (const auto pulls = json.find("pulls")) {
        require_at_most(kMostPulls, "pulls", *pulls);
        script.pulls = read_pulls(*pulls, kLongest_s);
    }
    const Reader reader(channels, facs, expressions);
    if (const auto table = json.find("channels"))
        for (const std::string& name : table->keys())
            script.channels.push_back(reader.channel(table->at(name), name));
    if (const auto emg = json.find("emg")) {
        EmgTracks read = read_emg(*emg, channels, script.header.duration_s);
        script.emg = std::move(read.tracks);
        script.notes = std::move(read.notes);
        script.recordings.push_back(existing_file(emg->at("file")));
    }
    if (const auto events = json.find("events")) {
        std::vector<JsonCursor> idle;
        require_at_most(kMostEvents, "events", *events);
        for (const JsonCursor& event : events->items()) {
            const int kinds =
                event.has("expression") + event.has("blink") + event.has("idle") + event.has("say");
            if (kinds != 1)
                event.fail("an event with one of \"expression\", \"blink\", \"idle\" and \"say\"",
                           kinds == 0   ? "none"
                           : kinds == 2 ? "two"
                           : kinds == 3 ? "three"
                                        : "four");
            if (event.has("expression"))
                script.expressions.push_back(reader.expression(
                    event, script.header, static_cast<int>(script.expressions.size())));
            else if (event.has("blink"))
                script.blinks.push_back(reader.blink(event, script.header.duration_s));
            else if (event.has("say"))
                script.says.push_back(event);
            else
                idle.push_back(event);
        }
        if (idle.size() > kMostIdleEvents)
            events->fail("at most " + std::to_string(kMostIdleEvents) + " periods of idle motion",
                         std::to_string(idle.size()));
        for (const JsonCursor& event : idle) {
            script.idle.push_back(
                reader.idle(event, script.header, static_cast<int>(script.idle.size())));
            reader.add_idle_blinks(event, script.idle.back(), script.blinks);
        }
    }
    return script;
}

}  // namespace risorius::track
