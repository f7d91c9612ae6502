// SPDX-License-Identifier: MIT
// Reads muscle shapes from JSON.
#include <limits>

#include "risorius/core/error.h"
#include "risorius/muscle/muscle_shape.h"

namespace risorius::muscle {

using Form = MuscleShape::Form;

namespace {

double read_positive(const JsonCursor& json) {
    if (!json.is_number() || !(json.number() > 0)) json.fail("a number in (0, inf)");
    return json.number();
}

std::vector<double> read_sizes(const JsonCursor& json) {
    if (!json.is_array()) return {read_positive(json)};
    std::vector<double> values;
    for (const JsonCursor& item : json.items()) values.push_back(read_positive(item));
    return values;
}

Points read_places(const JsonCursor& json) {
    const std::vector<JsonCursor> rows = json.items();
    Points points(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
        points.row(static_cast<Eigen::Index>(i)) = rows[i].vec3().transpose();
    return points;
}

Triangles read_triangles(const JsonCursor& json, Eigen::Index vertices) {
    const std::vector<JsonCursor> rows = json.items();
    Triangles triangles(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::vector<JsonCursor> corners = rows[i].items();
        if (corners.size() != 3) rows[i].fail("three indices of points");
        for (std::size_t k = 0; k < 3; ++k)
            triangles(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
                corners[k].integer(0, static_cast<int>(vertices) - 1);
    }
    return triangles;
}

void read_path(const JsonCursor& json, MuscleShape& shape) {
    json.allow_keys({"path_m", "outward", "width_m", "thickness_m", "section", "equal_volume"});
    shape.path_m = read_places(json.at("path_m"));
    if (const auto v = json.find("outward")) shape.outward = read_places(*v);
    shape.widths_m = read_sizes(json.at("width_m"));
    shape.thicknesses_m = read_sizes(json.at("thickness_m"));
    if (const auto v = json.find("section"))
        shape.section = v->one_of({"block", "round"}) == "round" ? MuscleShape::Section::kRound
                                                                 : MuscleShape::Section::kBlock;
}

void read_surface(const JsonCursor& json, MuscleShape& shape) {
    json.allow_keys({"points_m", "triangles", "path_m", "outward", "tip_ratio", "equal_volume"});
    shape.equal_volume = true;
    shape.surface_m = read_places(json.at("points_m"));
    shape.triangles = read_triangles(json.at("triangles"), shape.surface_m.rows());
    if (const auto v = json.find("path_m")) shape.path_m = read_places(*v);
    if (const auto v = json.find("outward")) shape.outward = read_places(*v);
    if (const auto v = json.find("tip_ratio")) shape.tip_ratio = v->number({0.001, 0.25});
}

}  // namespace

MuscleShape read_muscle_shape(const JsonCursor& json) {
    json.allow_keys({"block_m", "round", "sheet", "path", "ring", "surface"});
    const std::vector<std::string> given = json.keys();
    if (given.size() != 1)
        json.fail("one shape", given.empty() ? "none" : std::to_string(given.size()));
    MuscleShape shape;
    JsonCursor form = json.at(given[0]);
    if (given[0] == "block_m") {
        const std::vector<JsonCursor> edges = form.items();
        if (edges.size() != 3) form.fail("length, width and thickness");
        shape.length_m = read_positive(edges[0]);
        shape.width_m = read_positive(edges[1]);
        shape.thickness_m = read_positive(edges[2]);
    } else if (given[0] == "round") {
        shape.form = Form::kRound;
        form.allow_keys({"length_m", "width_m", "thickness_m", "end_ratio", "equal_volume"});
        shape.length_m = read_positive(form.at("length_m"));
        shape.width_m = read_positive(form.at("width_m"));
        shape.thickness_m = read_positive(form.at("thickness_m"));
        if (const auto v = form.find("end_ratio")) shape.end_ratio = v->number();
    } else if (given[0] == "sheet") {
        shape.form = Form::kSheet;
        form.allow_keys({"length_m", "origin_width_m", "insertion_width_m", "thickness_m"});
        shape.length_m = read_positive(form.at("length_m"));
        shape.width_m = read_positive(form.at("origin_width_m"));
        shape.insertion_width_m = read_positive(form.at("insertion_width_m"));
        shape.thickness_m = read_positive(form.at("thickness_m"));
    } else if (given[0] == "surface") {
        shape.form = Form::kSurface;
        form = follow_table(form);
        read_surface(form, shape);
    } else {
        shape.form = given[0] == "path" ? Form::kPath : Form::kRing;
        read_path(form, shape);
    }
    shape.place = form.place();
    if (form.is_object())
        if (const auto v = form.find("equal_volume")) shape.equal_volume = v->boolean();
    return shape;
}

}  // namespace risorius::muscle
