#include "app/measured_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/expression_drive.h"
#include "core/error.h"
#include "core/json_cursor.h"

namespace risorius::app {

namespace {

// The raw numbers, checked.
std::vector<float> read_numbers(const JsonCursor& json, std::size_t count) {
    std::filesystem::path file = json.file();
    file.replace_extension(".f32");
    if (const auto given = json.find("file")) file = given->path();
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (!in) throw Error(json.place(), "the file of its numbers", "no readable " + file.string());
    const auto bytes = static_cast<std::size_t>(in.tellg());
    if (bytes != count * sizeof(float))
        throw Error(file.string(),
                    std::to_string(count * sizeof(float)) + " bytes, as \"shape\" says",
                    std::to_string(bytes));
    std::vector<float> numbers(count);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(bytes));
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(numbers[i]))
            throw Error(file.string() + ": number " + std::to_string(i), "a finite number", "NaN");
    return numbers;
}

// The file's own "excitations" come before the rig's tables.
class Drives {
  public:
    Drives(const rig::RigDescription& rig, const JsonCursor& json)
        : rig_(rig), channels_(rig.channels()), json_(json) {}

    track::Expansion of(const std::string& name) const {
        if (const auto table = json_.find("excitations"))
            if (const auto given = table->find(name)) {
                track::Expansion out = track::Expansion::none(channels_);
                for (const std::string& source : given->keys()) add(*given, source, out);
                return out;
            }
        if (const auto known = expansion_named(rig_, name)) return *known;
        json_.at("names").fail(
            "names of ARKit shapes, action units or expressions of the rig, or \"excitations\" for "
            "the others",
            "\"" + name + "\"");
    }

  private:
    void add(const JsonCursor& given, const std::string& source, track::Expansion& out) const {
        const JsonCursor at = given.at(source);
        const double value = at.number();
        if (const auto channels = track::kinematic_named(source); !channels.empty()) {
            for (const track::Kinematic channel : channels)
                out.kinematic[static_cast<std::size_t>(channel)] += value;
        } else if (track::is_unit_number(source)) {
            const track::UnitUse use = track::unit_named(at, source, rig_.facs);
            out.add(track::expand(*rig_.facs.find(use.unit), use.side, channels_), value);
        } else {
            out.add(track::expand(track::muscle_named(at, source, channels_), channels_), value);
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
    const JsonCursor json = JsonCursor::read_file(file);
    const std::vector<JsonCursor> shape = json.at("shape").items();
    if (shape.size() != 3) json.at("shape").fail("[shapes, vertices, 3]");
    const int shapes = shape[0].integer(1, 100000), vertices = shape[1].integer(1, 100000000);
    if (shape[2].integer(1, 1000) != 3) shape[2].fail("3");
    if (vertices != head.vertices.rows())
        shape[1].fail("the " + std::to_string(head.vertices.rows()) +
                      " vertices of the rig's mesh");
    json.at("dtype").one_of({"<f4"});
    if (!json.at("layout").string().starts_with("[shape][vertex][xyz]"))
        json.at("layout").fail("\"[shape][vertex][xyz]\"");
    const double metres = json.has("units_per_metre")
                              ? 1.0 / json.at("units_per_metre").number({1e-9, 1e9})
                              : head.frame.metres_per_unit;
    std::vector<std::string> names;
    for (const JsonCursor& name : json.at("names").items()) names.push_back(name.string());
    if (static_cast<int>(names.size()) != shapes)
        json.at("names").fail("as many names as shapes, " + std::to_string(shapes),
                              std::to_string(names.size()));
    const std::vector<float> numbers = read_numbers(
        json, static_cast<std::size_t>(shapes) * static_cast<std::size_t>(vertices) * 3);

    const auto field = [&](std::size_t s) {
        Points out(vertices, 3);
        const float* at = numbers.data() + s * static_cast<std::size_t>(vertices) * 3;
        for (long v = 0; v < vertices; ++v)
            out.row(v) =
                (head.frame.rotation * (metres * Vec3(at[3 * v], at[3 * v + 1], at[3 * v + 2])))
                    .transpose();
        return out;
    };
    const auto index = [&](const std::string& name) -> std::optional<std::size_t> {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) return std::nullopt;
        return static_cast<std::size_t>(found - names.begin());
    };
    const auto under = [&](const std::string& name) -> std::optional<std::string> {
        if (const auto table = json.find("on_top_of"))
            if (const auto other = table->find(name)) return other->string();
        if (name == "mouthClose" && index("jawOpen")) return "jawOpen";
        return std::nullopt;
    };
    // Which shapes of the file make up each of ours
    const Drives drives(rig, json);
    std::vector<MeasuredShape> out;
    std::vector<char> used(names.size(), 0);
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (used[s]) continue;
        std::vector<std::size_t> parts{s};
        const SidedShape sided = split_shape(names[s]);
        MeasuredShape one;
        one.name = names[s];
        one.sided = sided.side.has_value();
        // mouthLeft and mouthRight are directions, not halves
        const bool direction = names[s] == "mouthLeft" || names[s] == "mouthRight" ||
                               names[s] == "jawLeft" || names[s] == "jawRight";
        if (sided.side && !options.apart && !direction)
            for (const char* ending : {"_L", "_R", "Left", "Right"})
                if (const auto other = index(sided.base + ending); other && *other != s) {
                    parts.push_back(*other);
                    one.name = sided.base;
                    one.sided = false;
                }
        for (const std::size_t part : parts) used[part] = 1;
        if (!options.only.empty() &&
            std::find(options.only.begin(), options.only.end(), one.name) == options.only.end())
            continue;
        track::Expansion sum = track::Expansion::none(rig.channels());
        one.displacement = Points::Zero(vertices, 3);
        const auto take = [&](const std::string& name, std::size_t part) {
            one.displacement += field(part);
            sum.add(drives.of(name), 1.0);
        };
        for (const std::size_t part : parts) take(names[part], part);
        if (const auto other = under(one.name)) {
            const auto at = index(*other);
            if (!at) json.at("on_top_of").fail("a name of the list", "\"" + *other + "\"");
            take(*other, *at);
        }
        one.drive = clamped_drive(sum, rig.channels());
        out.push_back(std::move(one));
    }
    for (const std::string& wanted : options.only)
        if (std::none_of(out.begin(), out.end(),
                         [&](const MeasuredShape& one) { return one.name == wanted; }))
            throw Error("--only", "names of shapes in " + file.string(), "\"" + wanted + "\"");
    return out;
}

}  // namespace risorius::app
