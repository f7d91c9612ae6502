// SPDX-License-Identifier: MIT
#include "risorius/inverse/measured_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/file_reader.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/known_names.h"
#include "risorius/rig/expression_drive.h"

namespace risorius::inverse {

namespace {

/// The content of the file.
struct ShapesFile {
    JsonCursor json;
    int vertices = 0;
    std::optional<double> units_per_metre;
    std::vector<std::string> names;
    std::vector<float> numbers;  ///< [shape][vertex][xyz]

    const float* numbers_of(std::size_t shape) const {
        return numbers.data() + 3 * shape * static_cast<std::size_t>(vertices);
    }
    std::optional<std::size_t> index(const std::string& name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) return std::nullopt;
        return static_cast<std::size_t>(found - names.begin());
    }
    /// Whether the file has a shape, or a pair of shapes with this common name.
    bool knows(const std::string& name) const {
        return std::any_of(names.begin(), names.end(), [&](const std::string& one) {
            return one == name || rig::split_shape(one).base == name;
        });
    }
};

constexpr FileKind kShapeNumbers{"a file of the numbers of shapes", 8000 * kMegabyte};

void read_numbers(ShapesFile& shapes) {
    std::filesystem::path file = shapes.json.file();
    file.replace_extension(".f32");
    if (const auto given = shapes.json.find("file")) file = given->path();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw Error(shapes.json.place(), "the file of its numbers", "no readable " + file.string());
    const std::size_t count = 3 * shapes.names.size() * static_cast<std::size_t>(shapes.vertices);
    FileReader in(file, kShapeNumbers);
    if (in.size() != count * sizeof(float))
        throw Error(file.string(),
                    std::to_string(count * sizeof(float)) + " bytes, as \"shape\" says",
                    in.is_regular() ? std::to_string(in.size()) : "a pipe");
    shapes.numbers.resize(count);
    if (in.read(shapes.numbers.data(), count * sizeof(float)) < count * sizeof(float))
        throw Error(file.string(), "a file that does not change", "one that became shorter");
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(shapes.numbers[i])) {
            const std::size_t vertex = i / 3, per_shape = static_cast<std::size_t>(shapes.vertices);
            throw Error(file.string() + ": \"" + shapes.names[vertex / per_shape] + "\", vertex " +
                            std::to_string(vertex % per_shape),
                        "finite numbers", std::isnan(shapes.numbers[i]) ? "NaN" : "infinity");
        }
}

ShapesFile read_shapes_file(const std::filesystem::path& file, const rig::Head& head) {
    ShapesFile out{JsonCursor::read_file(file), 0, {}, {}, {}};
    const JsonCursor& json = out.json;
    if (const auto format = json.find("format")) format->one_of({"risorius-shapes"});
    // "stats", "source" and "note" are informal and ignored.
    json.allow_keys({"format", "version", "shape", "dtype", "layout", "names", "file",
                     "units_per_metre", "excitations", "on_top_of", "stats", "source", "note"});
    if (const auto version = json.find("version")) version->integer(1, 1);
    const std::vector<JsonCursor> shape = json.at("shape").items();
    if (shape.size() != 3) json.at("shape").fail("[shapes, vertices, 3]");
    const int shapes = shape[0].integer(1, 100000);
    out.vertices = shape[1].integer(1, 100000000);
    shape[2].integer(3, 3);
    if (out.vertices != head.vertices.rows())
        shape[1].fail("the " + std::to_string(head.vertices.rows()) +
                      " vertices of the rig's mesh");
    json.at("dtype").one_of({"<f4"});
    if (!json.at("layout").string().starts_with("[shape][vertex][xyz]"))
        json.at("layout").fail("\"[shape][vertex][xyz]\"");
    if (const auto units = json.find("units_per_metre"))
        out.units_per_metre = units->number({1e-9, 1e9});
    for (const JsonCursor& name : json.at("names").items()) {
        if (out.index(name.string())) name.fail("each name once");
        out.names.push_back(name.string());
    }
    if (static_cast<int>(out.names.size()) != shapes)
        json.at("names").fail("as many names as shapes, " + std::to_string(shapes),
                              std::to_string(out.names.size()));
    for (const char* table : {"excitations", "on_top_of"})
        if (const auto found = json.find(table))
            for (const std::string& name : found->keys())
                if (!out.knows(name))
                    found->at(name).fail("one of the \"names\"" + did_you_mean(name, out.names),
                                         "\"" + name + "\"");
    if (const auto bases = json.find("on_top_of"))
        for (const std::string& name : bases->keys())
            if (const std::string base = bases->at(name).string(); !out.index(base))
                bases->at(name).fail("one of the \"names\"" + did_you_mean(base, out.names));
    read_numbers(out);
    return out;
}

// Drives of shapes; the "excitations" of the file take precedence over the rig's tables.
class Drives {
  public:
    Drives(const rig::RigDescription& rig, const JsonCursor& json)
        : rig_(rig), channels_(rig.channels()), json_(json) {}

    /// Whether the file gives the drive.
    bool given(const std::string& name) const {
        const auto table = json_.find("excitations");
        return table && table->has(name);
    }
    track::Expansion of(const std::string& name) const {
        if (const auto table = json_.find("excitations"))
            if (const auto given = table->find(name)) {
                track::Expansion out = track::Expansion::none(channels_);
                for (const std::string& source : given->keys()) add(*given, source, out);
                return out;
            }
        // A channel has no value of its own: "excitations" must give it
        if (track::kinematic_named(name).empty())
            if (const auto known = rig::expansion_at(rig_, name, 1)) return *known;
        std::vector<std::string> known;
        for (const track::ArkitShape& shape : rig_.facs.arkit) known.push_back(shape.name);
        for (const JsonCursor& one : json_.at("names").items())
            if (one.string() == name)
                one.fail("an ARKit shape, action unit or expression of the rig" +
                         did_you_mean(name, known) + ", or its activations under \"excitations\"");
        json_.at("names").fail("the name of a shape of the rig", "\"" + name + "\"");
    }

  private:
    void add(const JsonCursor& given, const std::string& source, track::Expansion& out) const {
        const JsonCursor at = given.at(source);
        if (const auto channels = track::kinematic_named(source); !channels.empty()) {
            for (const track::Kinematic channel : channels) {
                const auto k = static_cast<std::size_t>(channel);
                const track::KinematicChannel& range = track::kinematic_channels()[k];
                out.kinematic[k] += at.number({range.min, range.max});
            }
        } else if (track::is_unit_number(source)) {
            const track::UnitUse use = track::unit_named(at, source, rig_.facs);
            out.add(track::expand(*rig_.facs.find(use.unit), use.side, channels_),
                    at.number({0, 1}));
        } else {
            const track::MuscleFraction fraction = track::muscle_named(at, source, channels_);
            out.add(track::expand(fraction, channels_),
                    at.number({channels_.find(fraction.muscle)->min, 1}));
        }
    }

    const rig::RigDescription& rig_;
    track::ChannelTable channels_;
    const JsonCursor& json_;
};

}  // namespace

std::vector<MeasuredShape> read_measured_shapes(const std::filesystem::path& file,
                                                const MeasuredShapesOptions& options,
                                                const rig::RigDescription& rig,
                                                const rig::Head& head) {
    const ShapesFile shapes = read_shapes_file(file, head);
    const JsonCursor& json = shapes.json;
    const std::vector<std::string>& names = shapes.names;
    const double metres =
        shapes.units_per_metre ? 1.0 / *shapes.units_per_metre : head.frame.metres_per_unit;
    const auto field = [&](std::size_t s) {
        Points out(shapes.vertices, 3);
        const float* at = shapes.numbers_of(s);
        for (long v = 0; v < out.rows(); ++v)
            out.row(v) =
                (head.frame.rotation * (metres * Vec3(at[3 * v], at[3 * v + 1], at[3 * v + 2])))
                    .transpose();
        return out;
    };
    const auto under = [&](const std::string& name) -> std::optional<std::string> {
        if (const auto table = json.find("on_top_of"))
            if (const auto other = table->find(name)) return other->string();
        if (name == "mouthClose" && shapes.index("jawOpen")) return "jawOpen";
        return std::nullopt;
    };
    // The shapes of the file that are added to each result
    const Drives drives(rig, json);
    std::vector<MeasuredShape> out;
    std::vector<std::string> all;
    std::vector<char> used(names.size(), 0);
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (used[s]) continue;
        std::vector<std::size_t> parts{s};
        const rig::SidedShape sided = rig::split_shape(names[s]);
        MeasuredShape one;
        one.name = names[s];
        one.sided = sided.side.has_value();
        // mouthLeft and mouthRight are directions, not halves.
        const bool direction = names[s] == "mouthLeft" || names[s] == "mouthRight" ||
                               names[s] == "jawLeft" || names[s] == "jawRight";
        if (sided.side && !options.separate_sides && !direction)
            for (const char* ending : {"_L", "_R", "Left", "Right"})
                if (const auto other = shapes.index(sided.base + ending); other && *other != s) {
                    parts.push_back(*other);
                    one.name = sided.base;
                    one.sided = false;
                }
        for (const std::size_t part : parts) used[part] = 1;
        all.push_back(one.name);
        if (!options.only.empty() &&
            std::find(options.only.begin(), options.only.end(), one.name) == options.only.end())
            continue;
        track::Expansion sum = track::Expansion::none(rig.channels());
        one.displacement = Points::Zero(shapes.vertices, 3);
        const auto take = [&](const std::string& name, std::size_t part) {
            one.displacement += field(part);
            sum.add(drives.of(name), 1.0);
        };
        if (drives.given(one.name)) {
            for (const std::size_t part : parts) one.displacement += field(part);
            sum.add(drives.of(one.name), 1.0);
        } else {
            for (const std::size_t part : parts) take(names[part], part);
        }
        auto other = under(one.name);
        if (!other) other = under(names[s]);
        if (other) take(*other, *shapes.index(*other));
        one.drive = rig::clamped_drive(sum, rig.channels());
        out.push_back(std::move(one));
    }
    for (const std::string& wanted : options.only)
        if (std::none_of(out.begin(), out.end(),
                         [&](const MeasuredShape& one) { return one.name == wanted; }))
            throw Error(option_name("only"),
                        "names of shapes in " + file.string() + did_you_mean(wanted, all),
                        "\"" + wanted + "\"");
    return out;
}

}  // namespace risorius::inverse
