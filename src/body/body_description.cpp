#include "body/body_description.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tissue/grid_shape.h"

namespace risorius::body {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostNodesPerAxis = 1000;

const std::vector<Quantity>& solid_quantities() {
    static const std::vector<Quantity> list = {
        {"elastic", "elastic_n_per_m3", 3},
        {"damping", "damping_ns_per_m3", 3},
        {"incompressibility", "incompressibility_n_per_m5", 0},
        {"mass", "mass_kg", 0},
        {"drag", "drag_ns_per_m", 0}};
    return list;
}

double positive(const JsonCursor& json) {
    if (!json.is_number() || !(json.number() > 0)) json.fail("a number in (0, inf)");
    return json.number();
}

double not_negative(const JsonCursor& json) { return json.number({0, kInfinity}); }

double not_negative(const JsonCursor& json, std::string_view key, double otherwise) {
    const auto found = json.find(key);
    return found ? not_negative(*found) : otherwise;
}

tissue::GridShape read_grid(const JsonCursor& json) {
    const auto counts = json.items();
    if (counts.size() != 3) json.fail("three numbers of nodes, one per axis");
    const auto count = [&](std::size_t axis) { return counts[axis].integer(2, kMostNodesPerAxis); };
    return {.m = count(0), .n = count(1), .o = count(2)};
}

RestDescription read_rest(const JsonCursor& json, const tissue::GridShape& grid) {
    json.allow_keys({"block_m", "cylinder", "points_m", "at_m", "turn"});
    RestDescription rest;
    const int forms = json.has("block_m") + json.has("cylinder") + json.has("points_m");
    if (forms != 1)
        json.fail("one of \"block_m\", \"cylinder\" and \"points_m\"",
                  forms == 0 ? "none" : "several");

    if (const auto block = json.find("block_m")) {
        rest.form = RestDescription::Form::kBlock;
        rest.block_m = block->vec3();
        for (const JsonCursor& edge : block->items()) positive(edge);
    } else if (const auto cylinder = json.find("cylinder")) {
        cylinder->allow_keys({"radius_m", "length_m"});
        rest.form = RestDescription::Form::kCylinder;
        rest.radius_m = positive(cylinder->at("radius_m"));
        rest.length_m = positive(cylinder->at("length_m"));
    } else {
        rest.form = RestDescription::Form::kPoints;
        const JsonCursor points = json.at("points_m");
        const auto rows = points.items();
        if (static_cast<int>(rows.size()) != grid.size())
            points.fail(std::to_string(grid.size()) + " points, one per node of the grid",
                        std::to_string(rows.size()));
        rest.points_m.resize(grid.size(), 3);
        for (std::size_t i = 0; i < rows.size(); ++i)
            rest.points_m.row(static_cast<long>(i)) = rows[i].vec3().transpose();
    }

    if (const auto at = json.find("at_m")) rest.at_m = at->vec3();
    if (const auto turn = json.find("turn")) {
        turn->allow_keys({"axis", "angle_deg"});
        rest.turn_axis = turn->at("axis").vec3();
        if (!(rest.turn_axis.norm() > 0)) turn->at("axis").fail("a direction");
        rest.turn_axis.normalize();
        rest.turn_deg = turn->at("angle_deg").number({-360, 360});
    }
    return rest;
}

tissue::SolidMaterial read_solid_material(const JsonCursor& json) {
    json.allow_keys({"mass_kg", "elastic_n_per_m3", "damping_ns_per_m3",
                     "incompressibility_n_per_m5", "drag_ns_per_m", "parameters"});
    tissue::SolidMaterial material;
    material.mass_kg = positive(json.at("mass_kg"));
    material.elastic_n_per_m3 = read_tensor(json.at("elastic_n_per_m3"), 3);
    if (const auto damping = json.find("damping_ns_per_m3"))
        material.damping_ns_per_m3 = read_tensor(*damping, 3);
    material.incompressibility_n_per_m5 = not_negative(json, "incompressibility_n_per_m5", 0);
    material.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    return material;
}

bool has_moduli(const JsonCursor& material) {
    return material.has("shear_pa") || material.has("young_pa") || material.has("bulk_pa") ||
           material.has("density_kg_per_m3");
}

/// The elastic part is that of Lame's mu alone and K (J - 1)^2 / 2 adds to lambda, so that E = mu (3 K + 2 mu) / (K + mu).
double shear_of_young(double young_pa, double bulk_pa) {
    const double b = 3 * bulk_pa - young_pa;
    return (std::sqrt(b * b + 8 * young_pa * bulk_pa) - b) / 4;
}

ModuliDescription read_moduli(const JsonCursor& json) {
    json.allow_keys({"shear_pa", "young_pa", "bulk_pa", "density_kg_per_m3", "viscosity_pa_s",
                     "drag_ns_per_m"});
    ModuliDescription moduli;
    if (json.has("shear_pa") == json.has("young_pa"))
        json.fail("one of \"shear_pa\" and \"young_pa\"", json.has("shear_pa") ? "both" : "none");
    moduli.bulk_pa = not_negative(json, "bulk_pa", 0);
    if (json.has("shear_pa"))
        moduli.shear_pa = positive(json.at("shear_pa"));
    else
        moduli.shear_pa = shear_of_young(positive(json.at("young_pa")), moduli.bulk_pa);
    moduli.density_kg_per_m3 = positive(json.at("density_kg_per_m3"));
    moduli.viscosity_pa_s = not_negative(json, "viscosity_pa_s", 0);
    moduli.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    return moduli;
}

void change_material(tissue::SolidMaterial& material, const MaterialChange& change, double share) {
    const auto apply = [&](auto& value) { value = changed(value, change, share); };
    if (change.quantity == "elastic") apply(material.elastic_n_per_m3);
    if (change.quantity == "damping") apply(material.damping_ns_per_m3);
    if (change.quantity == "incompressibility") apply(material.incompressibility_n_per_m5);
    if (change.quantity == "mass") apply(material.mass_kg);
    if (change.quantity == "drag") apply(material.drag_ns_per_m);
}

Rigid placed(const RestDescription& rest) {
    Rigid place = Rigid::Identity();
    place.rotate(Eigen::AngleAxisd(rest.turn_deg * std::numbers::pi / 180, rest.turn_axis));
    place.translation() = rest.at_m;
    return place;
}

Points rest_points(const RestDescription& rest, const tissue::GridShape& grid) {
    const Rigid place = placed(rest);
    if (rest.form == RestDescription::Form::kBlock)
        return tissue::block_rest(grid, rest.block_m, place);
    if (rest.form == RestDescription::Form::kCylinder)
        return tissue::cylinder_rest(grid, rest.radius_m, rest.length_m, place);
    Points points = rest.points_m;
    for (long i = 0; i < points.rows(); ++i)
        points.row(i) = (place * Vec3(points.row(i).transpose())).transpose();
    return points;
}

/// lambda_ij = mu V0 / (Li^2 Lj^2), and so omega of the viscosity; psi = K / (2 V0), which differences spread over cells.
tissue::SolidMaterial material_of_block(const ModuliDescription& moduli, const Vec3& edges_m,
                                        const tissue::GridShape& grid,
                                        Discretisation discretisation) {
    const double volume = edges_m.prod();
    tissue::SolidMaterial material;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double edges = edges_m[i] * edges_m[j];
            material.elastic_n_per_m3(i, j) = moduli.shear_pa * volume / (edges * edges);
            material.damping_ns_per_m3(i, j) = moduli.viscosity_pa_s * volume / (edges * edges);
        }
    material.incompressibility_n_per_m5 = moduli.bulk_pa / (2 * volume);
    if (discretisation == Discretisation::kDifferences)
        material.incompressibility_n_per_m5 *= grid.spacing(0) * grid.spacing(1) * grid.spacing(2);
    material.mass_kg = moduli.density_kg_per_m3 * volume;
    material.drag_ns_per_m = moduli.drag_ns_per_m;
    return material;
}

}  // namespace

BodyDescription read_body(const JsonCursor& json) {
    json.allow_keys({"kind", "discretisation", "grid", "rest", "material", "regions", "fixed",
                     "gravity_m_per_s2"});
    BodyDescription body;
    body.place = json.place();
    json.at("kind").one_of({"solid"});
    body.grid = read_grid(json.at("grid"));
    body.rest = read_rest(json.at("rest"), body.grid);
    if (const auto discretisation = json.find("discretisation"))
        body.discretisation = discretisation->one_of({"differences", "cells"}) == "cells"
                                  ? Discretisation::kCells
                                  : Discretisation::kDifferences;

    const JsonCursor material = json.at("material");
    if (has_moduli(material)) {
        if (body.rest.form != RestDescription::Form::kBlock)
            material.fail("lambda, omega and psi where the rest shape is not a block", "moduli");
        body.moduli = read_moduli(material);
    } else {
        body.material = read_solid_material(material);
        if (const auto parameters = material.find("parameters")) {
            const bool raw =
                parameters->one_of({"resolution-independent", "per-node"}) == "per-node";
            if (raw && body.discretisation == Discretisation::kCells)
                parameters->fail("\"resolution-independent\", which is all that cells know");
            body.parameters =
                raw ? tissue::Parameters::kPerNode : tissue::Parameters::kResolutionIndependent;
        }
    }
    if (const auto regions = json.find("regions"))
        body.regions = read_regions(*regions, solid_quantities(), 3);
    if (const auto fixed = json.find("fixed"))
        for (const JsonCursor& selection : fixed->items())
            body.fixed.push_back(read_node_selection(selection, 3));
    if (const auto gravity = json.find("gravity_m_per_s2")) body.gravity_m_per_s2 = gravity->vec3();

    // What only the whole shows: a folded rest shape, a plane the grid does not have.
    tissue::check(grid_solid(body), body.place);
    fixed_flags(body);
    return body;
}

tissue::GridSolid grid_solid(const BodyDescription& description) {
    const tissue::GridShape& grid = description.grid;
    tissue::GridSolid solid;
    solid.grid = grid;
    solid.parameters = description.parameters;
    const RestDescription& rest = description.rest;
    if (rest.form == RestDescription::Form::kPoints && rest.points_m.rows() != grid.size())
        throw Error(description.place + "/rest/points_m",
                    std::to_string(grid.size()) + " points, one per node of the grid",
                    std::to_string(rest.points_m.rows()));
    solid.rest = rest_points(rest, grid);

    const tissue::SolidMaterial whole =
        description.moduli
            ? material_of_block(*description.moduli, rest.block_m, grid, description.discretisation)
            : description.material;
    if (description.regions.empty()) {
        solid.material = {whole};
        return solid;
    }
    solid.material.assign(static_cast<std::size_t>(grid.size()), whole);
    for_each_change(
        description.regions, grid, [&](int node, const MaterialChange& change, double share) {
            change_material(solid.material[static_cast<std::size_t>(node)], change, share);
        });
    return solid;
}

std::vector<double> relative_stiffness(const BodyDescription& description) {
    std::vector<double> stiffness;
    if (description.regions.empty()) return stiffness;
    for (const tissue::SolidMaterial& material : grid_solid(description).material)
        stiffness.push_back(std::log(std::max(material.elastic_n_per_m3.mean(), 1e-300)));
    return stiffness;
}

std::vector<char> fixed_flags(const BodyDescription& description) {
    std::vector<char> flags(static_cast<std::size_t>(description.grid.size()), 0);
    for (const NodeSelection& selection : description.fixed)
        for (const int node : select(selection, description.grid))
            flags[static_cast<std::size_t>(node)] = 1;
    return flags;
}

}  // namespace risorius::body
