// SPDX-License-Identifier: MIT
#include "risorius/softbody/detail/rest_description.h"

#include <numbers>

#include "risorius/softbody/detail/read_numbers.h"
#include "risorius/tissue/grid_shape.h"
#include "risorius/tissue/surface_material.h"

namespace risorius::softbody {
namespace {

using Form = RestDescription::Form;

struct NamedForm {
    std::string_view key;
    Form form;
};

std::vector<NamedForm> forms_of(Kind kind) {
    if (kind == Kind::kSolid)
        return {
            {"block_m", Form::kBlock}, {"cylinder", Form::kCylinder}, {"points_m", Form::kPoints}};
    if (kind == Kind::kSurface) return {{"sheet_m", Form::kSheet}, {"points_m", Form::kPoints}};
    if (kind == Kind::kCurve) return {{"path_m", Form::kPath}, {"points_m", Form::kPoints}};
    return {{"tube", Form::kTube}, {"points_m", Form::kPoints}};
}

void read_edges(const JsonCursor& json, std::size_t count, Vec3& edges_m) {
    const auto edges = json.items();
    if (edges.size() != count) json.fail(std::to_string(count) + " edge lengths");
    for (std::size_t i = 0; i < count; ++i)
        edges_m[static_cast<long>(i)] = detail::positive(edges[i]);
}

void read_round(const JsonCursor& json, RestDescription& rest) {
    json.allow_keys({"radius_m", "length_m"});
    rest.radius_m = detail::positive(json.at("radius_m"));
    rest.length_m = detail::positive(json.at("length_m"));
}

void read_points(const JsonCursor& json, Points& points_m) {
    const auto rows = json.items();
    points_m.resize(static_cast<long>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
        points_m.row(static_cast<long>(i)) = rows[i].vec3().transpose();
}

void read_path(const JsonCursor& json, Points& points_m) {
    if (json.items().size() < 2)
        json.fail("at least 2 points", std::to_string(json.items().size()));
    read_points(json, points_m);
    for (long i = 1; i < points_m.rows(); ++i)
        if (!((points_m.row(i) - points_m.row(i - 1)).norm() > 0))
            json.items()[static_cast<std::size_t>(i)].fail("a point apart from the one before");
}

/// Nodes along a path, evenly spaced by length.
Points along_path(const Points& corners, int nodes) {
    std::vector<double> length{0};
    for (long i = 1; i < corners.rows(); ++i)
        length.push_back(length.back() + (corners.row(i) - corners.row(i - 1)).norm());
    Points points(nodes, 3);
    std::size_t side = 1;
    for (int node = 0; node < nodes; ++node) {
        const double s = length.back() * node / (nodes - 1);
        while (side + 1 < length.size() && s > length[side]) ++side;
        const double fraction = (s - length[side - 1]) / (length[side] - length[side - 1]);
        const long end = static_cast<long>(side);
        points.row(node) = (1 - fraction) * corners.row(end - 1) + fraction * corners.row(end);
    }
    return points;
}

}  // namespace

RestDescription read_rest(const JsonCursor& json, Kind kind) {
    const std::vector<NamedForm> forms = forms_of(kind);
    std::vector<std::string_view> known;
    std::string choices;
    for (const NamedForm& form : forms) {
        known.push_back(form.key);
        choices += (choices.empty()          ? "\""
                    : &form == &forms.back() ? " and \""
                                             : ", \"") +
                   std::string(form.key) + "\"";
    }
    known.insert(known.end(), {"at_m", "turn"});
    json.allow_keys(known);

    RestDescription rest;
    rest.place = json.place();
    int given = 0;
    for (const NamedForm& form : forms)
        if (json.has(form.key)) {
            rest.form = form.form;
            ++given;
        }
    if (given != 1) json.fail("one of " + choices, given == 0 ? "none" : "several");

    switch (rest.form) {
        case Form::kBlock:
            read_edges(json.at("block_m"), 3, rest.edges_m);
            break;
        case Form::kSheet:
            read_edges(json.at("sheet_m"), 2, rest.edges_m);
            break;
        case Form::kCylinder:
            read_round(json.at("cylinder"), rest);
            break;
        case Form::kTube:
            read_round(json.at("tube"), rest);
            break;
        case Form::kPath:
            read_path(json.at("path_m"), rest.points_m);
            break;
        case Form::kPoints:
            read_points(json.at("points_m"), rest.points_m);
            break;
    }

    if (const auto turn = json.find("turn")) {
        turn->allow_keys({"axis", "angle_deg"});
        const Vec3 axis = turn->at("axis").vec3();
        if (!(axis.norm() > 0)) turn->at("axis").fail("a direction");
        const double angle_deg = turn->at("angle_deg").number({-360, 360});
        rest.placed.linear() =
            Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, axis.normalized()).matrix();
    }
    if (const auto at = json.find("at_m")) rest.placed.translation() = at->vec3();
    return rest;
}

Points rest_points(const RestDescription& rest, const tissue::GridShape& grid) {
    switch (rest.form) {
        case Form::kBlock:
            return tissue::block_rest(grid, rest.edges_m, rest.placed);
        case Form::kCylinder:
            return tissue::cylinder_rest(grid, rest.radius_m, rest.length_m, rest.placed);
        case Form::kSheet:
            return tissue::sheet_rest({.m = grid.m, .n = grid.n}, rest.edges_m.head<2>(),
                                      rest.placed);
        case Form::kTube:
            return tissue::tube_rest({.m = grid.m, .n = grid.n, .closed = true}, rest.radius_m,
                                     rest.length_m, rest.placed);
        case Form::kPath:
        case Form::kPoints:
            break;
    }
    const bool path = rest.form == Form::kPath;
    if (!path && rest.points_m.rows() != grid.size())
        throw Error(rest.place + "/points_m",
                    std::to_string(grid.size()) + " points, one per node of the grid",
                    std::to_string(rest.points_m.rows()));
    Points points = path ? along_path(rest.points_m, grid.m) : rest.points_m;
    for (long i = 0; i < points.rows(); ++i)
        points.row(i) = (rest.placed * Vec3(points.row(i).transpose())).transpose();
    return points;
}

}  // namespace risorius::softbody
