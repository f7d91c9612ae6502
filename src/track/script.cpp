#include "track/script.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "track/emg_source.h"
#include "track/timeline.h"

namespace risorius::track {

namespace {

constexpr double kLongest_s = 3600;

ScriptView read_view(const JsonCursor& json) {
    json.allow_keys({"width_px", "height_px", "camera", "show", "background"});
    ScriptView view;
    if (const auto v = json.find("width_px")) view.width_px = v->integer(16, 8192);
    if (const auto v = json.find("height_px")) view.height_px = v->integer(16, 8192);
    if (const auto v = json.find("camera"))
        view.camera = v->one_of(
            {"front", "three_quarter", "three_quarter_right", "profile", "profile_right"});
    if (const auto v = json.find("show")) view.show = v->one_of({"skin", "muscles"});
    if (const auto v = json.find("background")) {
        const char* expected = "a colour \"#rrggbb\" or \"transparent\"";
        if (!v->is_string()) v->fail(expected);
        const std::string colour = v->string();
        if (colour == "transparent") {
            view.transparent = true;
        } else {
            if (colour.size() != 7 || colour[0] != '#' ||
                colour.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
                v->fail(expected);
            for (std::size_t i = 0; i < 3; ++i)
                view.background_rgb[i] =
                    std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
        }
    }
    return view;
}

ScriptHeader read_header(const JsonCursor& json) {
    json.allow_keys({"format", "version", "rig", "fps", "duration_s", "seed", "jaw", "channels",
                     "emg", "events", "view"});
    json.at("format").one_of({"risorius-script"});
    const JsonCursor version = json.at("version");
    if (version.json() != 1) version.fail("1, the version of the format this program reads");
    ScriptHeader header;
    header.rig = json.at("rig").string();
    if (header.rig.empty()) json.at("rig").fail("the path of a rig file");
    header.rig_file = json.at("rig").path();
    if (const auto v = json.find("fps")) header.fps = v->integer(1, 240);
    const JsonCursor duration = json.at("duration_s");
    header.duration_s = duration.number();
    if (!(header.duration_s > 0 && header.duration_s <= kLongest_s))
        duration.fail("(0, " + format_number(kLongest_s) + "]");
    if (header.frame_count() < 1)
        duration.fail("at least one frame at " + std::to_string(header.fps) + " fps");
    if (const auto v = json.find("seed")) header.seed = v->integer(0, 2147483647);
    if (const auto v = json.find("jaw"))
        header.jaw = v->one_of({"channels", "muscles"}) == "muscles" ? JawDrive::kMuscles
                                                                     : JawDrive::kChannels;
    if (const auto v = json.find("view")) header.view = read_view(*v);
    return header;
}

/// Resolves the names of one script against one rig.
class Reader {
  public:
    Reader(const ChannelTable& channels, const FacsTable& facs, const Expressions& expressions)
        : channels_(channels), facs_(facs), expressions_(expressions) {}

    ChannelTrack channel(const JsonCursor& json, const std::string& name) const {
        json.allow_keys({"keys", "interpolation", "activation"});
        ChannelTrack track;
        track.name = name;
        Range range{0, 1};
        bool is_muscle = false;
        track.drives = resolve(json, name, range, is_muscle);

        if (const auto v = json.find("activation")) {
            track.activation = v->boolean();
            if (track.activation && !is_muscle)
                v->fail("\"activation\" on the channel of a muscle only");
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

    ExpressionEvent expression(const JsonCursor& json, double duration_s) const {
        json.allow_keys(
            {"expression", "intensity", "start_s", "onset_s", "hold_s", "offset_s", "side"});
        const JsonCursor name = json.at("expression");
        const Expression* usual = expressions_.find(name.string());
        if (!usual) {
            std::vector<std::string_view> known;
            for (const Expression& e : expressions_.list) known.push_back(e.name);
            const std::string near = nearest_name(name.string(), known);
            std::string expected =
                near.empty() ? "one of"
                             : "an expression of the rig (did you mean " + quoted(near) + "?)";
            if (near.empty())
                for (std::string_view k : known) expected += " " + quoted(std::string(k));
            name.fail(expected);
        }
        ExpressionEvent event;
        event.expression = usual->name;
        event.intensity = optional_number(json, "intensity", 1, {0, 1});
        event.start_s = json.at("start_s").number({0, duration_s});
        event.onset_s = optional_number(json, "onset_s", usual->onset_s, {0, 60});
        event.hold_s = optional_number(json, "hold_s", usual->hold_s, {0, kLongest_s});
        event.offset_s = optional_number(json, "offset_s", usual->offset_s, {0, 60});
        event.side = read_side(json);
        for (const ExpressionUnit& part : usual->units) {
            // A unit that is one-sided in the table moves over to the side the event asks for.
            const std::optional<Side> side = event.side ? event.side : part.use.side;
            Expansion drives = Expansion::none(channels_);
            drives.add(expand(*facs_.find(part.use.unit), side, channels_),
                       part.use.value * event.intensity);
            event.parts.push_back({std::move(drives), part.delay});
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
        const ActionUnit* unit = facs_.find("AU45");
        if (!unit) json.at("blink").fail("a rig whose facs table has AU45", "none");
        event.drives = Expansion::none(channels_);
        event.drives.add(expand(*unit, event.side, channels_), event.intensity);
        return event;
    }

  private:
    /// Also gives the range of the channel's values and whether it is a muscle.
    Expansion resolve(const JsonCursor& json, const std::string& name, Range& range,
                      bool& is_muscle) const {
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
        const std::string id = split_side(name).id;
        if (const MuscleChannel* muscle = channels_.find(id)) {
            is_muscle = true;
            range = {muscle->min, 1};
            return expand(muscle_named(json, name, channels_), channels_);
        }
        if (facs_.find(id) || facs_.find(name) || facs_.find(id + ".l") || is_unit_number(id)) {
            const UnitUse use = unit_named(json, name, facs_);
            return expand(*facs_.find(use.unit), use.side, channels_);
        }
        std::vector<std::string_view> known;
        for (const MuscleChannel& muscle : channels_.muscles) known.push_back(muscle.id);
        for (const ActionUnit& unit : facs_.units) known.push_back(unit.id);
        for (const KinematicChannel& channel : kinematic_channels())
            known.push_back(channel.name.ends_with(".l") || channel.name.ends_with(".r")
                                ? channel.name.substr(0, channel.name.size() - 2)
                                : channel.name);
        const std::string near = nearest_name(id, known);
        json.fail("a muscle, action unit or kinematic channel of the rig" +
                      (near.empty() ? "" : " (did you mean " + quoted(near) + "?)"),
                  quoted(name));
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

}  // namespace

int frame_count(double duration_s, int fps) {
    return static_cast<int>(std::lround(duration_s * fps));
}

int ScriptHeader::frame_count() const { return track::frame_count(duration_s, fps); }

ScriptHeader read_script_header(const std::filesystem::path& file) {
    return read_header(JsonCursor::read_file(file));
}

ScriptDescription read_script(const std::filesystem::path& file, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions) {
    return read_script(JsonCursor::read_file(file), channels, facs, expressions);
}

ScriptDescription read_script(const JsonCursor& json, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions) {
    ScriptDescription script;
    script.header = read_header(json);
    const Reader reader(channels, facs, expressions);
    if (const auto table = json.find("channels"))
        for (const std::string& name : table->keys())
            script.channels.push_back(reader.channel(table->at(name), name));
    if (const auto emg = json.find("emg")) {
        script.emg = read_emg(*emg, channels);
        script.recordings.push_back(emg->at("file").path());
    }
    if (const auto events = json.find("events"))
        for (const JsonCursor& event : events->items()) {
            if (event.has("expression") == event.has("blink"))
                event.fail("an event with either \"expression\" or \"blink\"",
                           event.has("blink") ? "both" : "neither");
            if (event.has("expression"))
                script.expressions.push_back(reader.expression(event, script.header.duration_s));
            else
                script.blinks.push_back(reader.blink(event, script.header.duration_s));
        }
    return script;
}

}  // namespace risorius::track
