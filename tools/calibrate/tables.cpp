// SPDX-License-Identifier: MIT
#include "tools/calibrate/tables.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_text.h"
#include "risorius/report/atomic_file.h"

namespace risorius::calibrate {

namespace {

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

// Rounds to two significant digits.
double short_of(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return rounded(value, unit);
}

std::string line_of(const Json& value) {
    if (value.is_number_float()) {
        char text[40];
        std::snprintf(text, sizeof text, "%.9g", value.get<double>() + 0.0);
        return text;
    }
    if (!value.is_structured()) return json_text(value);
    std::string out;
    for (const auto& [key, one] : value.items()) {
        if (!out.empty()) out += ", ";
        if (value.is_object()) out += json_text(Json(key)) + ": ";
        out += line_of(one);
    }
    return value.is_object() ? "{" + out + "}" : "[" + out + "]";
}

// Writes objects and arrays over several lines down to `depth`, deeper ones on a single line.
std::string text_of(const Json& value, int depth, const std::string& indent = "") {
    if (!value.is_structured() || depth == 0 || value.empty()) return line_of(value);
    std::string out = value.is_object() ? "{\n" : "[\n";
    std::size_t left = value.size();
    for (const auto& [key, one] : value.items()) {
        out += indent + "  ";
        if (value.is_object()) out += json_text(Json(key)) + ": ";
        out += text_of(one, depth - 1, indent + "  ");
        out += --left > 0 ? ",\n" : "\n";
    }
    return out + indent + (value.is_object() ? "}" : "]");
}

bool searched(const std::string& muscle, const std::vector<inverse::ActivationUnknown>& unknowns) {
    for (const inverse::ActivationUnknown& unknown : unknowns)
        if (track::split_side(unknown.name).id == muscle) return true;
    return false;
}

Json read(const std::filesystem::path& file) { return JsonCursor::read_file(file).json(); }

}  // namespace

void write_tables(const rig::RigDescription& rig, const std::map<std::string, double>& stretch,
                  const std::filesystem::path& folder) {
    Json attachments = read(folder / "attachments.json");
    for (const rig::AttachmentSample& sample : rig.atlas.attachments)
        attachments["attachments"][sample.landmark] = {short_of(sample.normal_pa_per_m),
                                                       short_of(sample.tangential_pa_per_m)};
    report::write_text(folder / "attachments.json", text_of(attachments, 2) + "\n");

    Json bands = read(folder / "muscle_bands.json");
    std::size_t b = 0;
    for (auto& [muscle, list] : bands["muscles"].items())
        for (Json& band : list) {
            const rig::MuscleBand& found = rig.atlas.bands.at(b++);
            band["calibration"] = rounded(found.strength, 0.01);
            if (const auto length = stretch.find(muscle); length != stretch.end())
                band["shortens_to"] = rounded(length->second, 0.01);
            for (std::size_t i = 0; i < found.points.size(); ++i) {
                for (int k = 0; k < 3; ++k)
                    band["points"][i]["offset_mm"][static_cast<std::size_t>(k)] =
                        rounded(1e3 * found.points[i].offset[k], 0.1);
                if (found.points[i].depth >= 0)
                    band["points"][i]["depth"] = rounded(found.points[i].depth, 0.01);
            }
        }
    report::write_text(folder / "muscle_bands.json", text_of(bands, 3) + "\n");
}

void write_shapes(const std::vector<inverse::MeasuredShape>& shapes, const Result& result,
                  const rig::RigDescription& rig, double min, const std::filesystem::path& folder) {
    Json facs = read(folder / "facs.json");
    for (std::size_t e = 0; e < shapes.size(); ++e) {
        const auto write = [&](const std::string& name, const std::string& side,
                               bool mirrored = false) {
            const auto sided_name = [&](std::string id) {
                if (!mirrored) return id;
                if (id.ends_with(".l"))
                    id.back() = 'r';
                else if (id.ends_with(".r"))
                    id.back() = 'l';
                return id;
            };
            Json& shape = facs["arkit"][name];
            // A shape that is a single whole unit changes that unit.
            Json* target = &shape;
            std::string ending = side;
            if (shape.contains("units") && shape["units"].size() == 1 &&
                !shape.contains("muscles") && shape["units"].begin().value() == 1) {
                const std::string unit = shape["units"].begin().key();
                const track::SidedName sided = track::split_side(unit);
                target =
                    &facs["action_units"][facs["action_units"].contains(unit) ? unit : sided.id];
                if (sided.side) ending.clear();
            }
            Json muscles = Json::object(), jaw = Json::object();
            if (target->contains("muscles"))  // values that the search did not change stay
                for (const auto& [id, value] : (*target)["muscles"].items())
                    if (!searched(track::split_side(id).id, result.unknowns[e]))
                        muscles[id] = value;
            for (std::size_t i = 0; i < result.unknowns[e].size(); ++i) {
                const inverse::ActivationUnknown& unknown = result.unknowns[e][i];
                double value = rounded(result.activations[e][static_cast<long>(i)], 0.01);
                if (std::abs(value) < min) value = 0;
                const bool listed = inverse::value_of(unknown, shapes[e].drive) != 0;
                if (value == 0 && !(listed && target == &shape)) continue;
                if (unknown.channels.empty()) {
                    const bool paired = unknown.columns.size() == 2;
                    muscles[sided_name(unknown.name + (paired ? ending : ""))] =
                        !paired && !ending.empty() ? 0.5 * value : value;
                } else if (unknown.channels.front() == track::Kinematic::kJawOpen) {
                    jaw["open"] = value;
                } else if (unknown.channels.front() == track::Kinematic::kJawForward) {
                    jaw["protrude_mm"] = rounded(value * rig.facs.ranges.jaw_forward_mm, 0.1);
                } else if (unknown.channels.front() == track::Kinematic::kJawSide) {
                    jaw["lateral_mm"] =
                        rounded((mirrored ? -value : value) * rig.facs.ranges.jaw_side_mm, 0.1);
                }
            }
            (*target)["muscles"] = muscles;
            Json& moved = shape.contains("jaw") ? shape : *target;
            moved.erase("jaw");
            if (!jaw.empty()) moved["jaw"] = jaw;
        };
        const std::string& name = shapes[e].name;
        const Json& arkit = facs["arkit"];
        const bool whole = arkit.contains(name), left = arkit.contains(name + "Left"),
                   right = arkit.contains(name + "Right");
        if (whole) write(name, "");
        // For mouthLeft and jawLeft, the other direction is the mirror image.
        if (whole && shapes[e].sided && name.ends_with("Left"))
            write(name.substr(0, name.size() - 4) + "Right", "", true);
        if (left) write(name + "Left", ".l");
        if (right) write(name + "Right", ".r");
    }
    report::write_text(folder / "facs.json", text_of(facs, 2) + "\n");
}

void write_ways(const scene::DisplacementTable& ways, const std::filesystem::path& folder) {
    const Json json = scene::landmark_displacements_json(
        ways,
        "How the landmarks of the head in calibration.json go in its calibrated expressions, mm at "
        "atlas size; written by tools/calibrate");
    report::write_text(folder / "landmark_ways.json", text_of(json, 2) + "\n");
}

}  // namespace risorius::calibrate
