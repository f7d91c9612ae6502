// SPDX-License-Identifier: MIT
#include "risorius/muscle/curve_sets.h"

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace risorius::muscle {

namespace {

template <class Shape>
using Fields = std::vector<std::pair<std::string_view, double Shape::*>>;

const Fields<ZajacShape>& fields_of(const ZajacShape&) {
    static const Fields<ZajacShape> fields = {
        {"passive_strain", &ZajacShape::passive_strain},
        {"passive_exponent", &ZajacShape::passive_exponent},
        {"hill_curvature", &ZajacShape::hill_curvature},
        {"lengthening_force", &ZajacShape::lengthening_force},
        {"tendon_strain", &ZajacShape::tendon_strain},
        {"tendon_toe_force", &ZajacShape::tendon_toe_force},
        {"tendon_toe_exponent", &ZajacShape::tendon_toe_exponent}};
    return fields;
}

const Fields<ThelenShape>& fields_of(const ThelenShape&) {
    static const Fields<ThelenShape> fields = {
        {"active_width", &ThelenShape::active_width},
        {"passive_strain", &ThelenShape::passive_strain},
        {"passive_exponent", &ThelenShape::passive_exponent},
        {"hill_curvature", &ThelenShape::hill_curvature},
        {"lengthening_force", &ThelenShape::lengthening_force},
        {"tendon_strain", &ThelenShape::tendon_strain},
        {"tendon_toe_force", &ThelenShape::tendon_toe_force},
        {"tendon_toe_exponent", &ThelenShape::tendon_toe_exponent}};
    return fields;
}

const Fields<MillardShape>& fields_of(const MillardShape&) {
    using M = MillardShape;
    static const Fields<M> fields = {{"active_shortest", &M::active_shortest},
                                     {"active_transition", &M::active_transition},
                                     {"active_longest", &M::active_longest},
                                     {"active_shallow_slope", &M::active_shallow_slope},
                                     {"active_minimum", &M::active_minimum},
                                     {"passive_strain", &M::passive_strain},
                                     {"passive_low_stiffness", &M::passive_low_stiffness},
                                     {"passive_steepness", &M::passive_steepness},
                                     {"passive_curviness", &M::passive_curviness},
                                     {"shortening_end_slope", &M::shortening_end_slope},
                                     {"isometric_slope", &M::isometric_slope},
                                     {"lengthening_end_slope", &M::lengthening_end_slope},
                                     {"lengthening_force", &M::lengthening_force},
                                     {"shortening_curviness", &M::shortening_curviness},
                                     {"lengthening_curviness", &M::lengthening_curviness},
                                     {"tendon_strain", &M::tendon_strain},
                                     {"tendon_steepness", &M::tendon_steepness},
                                     {"tendon_toe_force", &M::tendon_toe_force},
                                     {"tendon_curviness", &M::tendon_curviness}};
    return fields;
}

/// Reads [[l, f], ...].
std::vector<std::pair<double, double>> read_points(const JsonCursor& json) {
    std::vector<std::pair<double, double>> points;
    for (const JsonCursor& point : json.items()) {
        const std::vector<JsonCursor> pair = point.items();
        if (pair.size() != 2) point.fail("[length, force]");
        points.emplace_back(pair[0].number(), pair[1].number());
    }
    return points;
}

MuscleCurves curves_of(const ZajacShape& shape) { return zajac_curves(shape); }
MuscleCurves curves_of(const ThelenShape& shape) { return thelen_curves(shape); }
MuscleCurves curves_of(const MillardShape& shape) { return millard_curves(shape); }

/// `what` has the form "zajac_curves: passive_strain > 0". The message names the first key in it that the file gives.
[[noreturn]] void refuse(const JsonCursor& json, const std::string& what) {
    const std::string rule = what.substr(what.find(": ") + 2);
    std::string blamed;
    for (const std::string& key : json.keys())
        if (rule.find(key) < rule.find(blamed.empty() ? "\n" : blamed)) blamed = key;
    if (blamed.empty()) json.fail(rule);
    json.at(blamed).fail(rule);
}

template <class Shape>
void read_fields(const JsonCursor& json, Shape& shape) {
    std::vector<std::string_view> known = {"set"};
    if constexpr (std::is_same_v<Shape, ZajacShape>) known.push_back("active_points");
    for (const auto& [key, field] : fields_of(shape)) known.push_back(key);
    json.allow_keys(known);
    for (const auto& [key, field] : fields_of(shape))
        if (const auto value = json.find(key)) shape.*field = value->number();
    if constexpr (std::is_same_v<Shape, ZajacShape>)
        if (const auto points = json.find("active_points"))
            shape.active_points = read_points(*points);
    try {
        curves_of(shape);
    } catch (const std::invalid_argument& refused) {
        refuse(json, refused.what());
    }
}

}  // namespace

const std::vector<std::string_view>& curve_set_names() {
    static const std::vector<std::string_view> names = {"zajac", "thelen2003", "millard2013"};
    return names;
}

CurveShape curve_set_named(const std::string& name, const std::string& place) {
    if (name == "zajac") return ZajacShape{};
    if (name == "thelen2003") return ThelenShape{};
    if (name == "millard2013") return MillardShape{};
    std::string expected = "one of";
    for (std::string_view known : curve_set_names()) expected += " \"" + std::string(known) + "\"";
    throw Error(place, expected, "\"" + name + "\"");
}

CurveShape read_curve_shape(const JsonCursor& json) {
    const JsonCursor set = json.is_string() ? json : json.at("set");
    CurveShape shape = curve_set_named(set.string(), set.place());
    if (!json.is_string()) std::visit([&json](auto& chosen) { read_fields(json, chosen); }, shape);
    return shape;
}

MuscleCurves make_curves(const CurveShape& shape) {
    return std::visit([](const auto& chosen) { return curves_of(chosen); }, shape);
}

}  // namespace risorius::muscle
