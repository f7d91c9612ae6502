#include "body/body_description.h"

#include <array>
#include <cmath>
#include <limits>

#include "tissue/grid_shape.h"
#include "tissue/moduli.h"

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
        moduli.young_pa = positive(json.at("young_pa"));
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
        body.moduli = read_moduli(material);
    } else {
        body.material = read_solid_material(material);
        if (const auto parameters = material.find("parameters")) {
            const bool raw =
                parameters->one_of({"resolution-independent", "per-node"}) == "per-node";
            if (raw && body.discretisation == Discretisation::kCells)
                parameters->fail("\"resolution-independent\", which is all that cells know");
            body.parameters = raw ? tissue::Parameters::kPerNode
                                  : tissue::Parameters::kResolutionIndependent;
        }
    }
    if (const auto regions = json.find("regions"))
        body.regions = read_regions(*regions, solid_quantities(), 3);
    if (const auto fixed = json.find("fixed"))
        for (const JsonCursor& selection : fixed->items())
            body.fixed.push_back(read_node_selection(selection, 3));
    if (const auto gravity = json.find("gravity_m_per_s2"))
        body.gravity_m_per_s2 = gravity->vec3();

    // What only the whole shows: a folded rest shape, a plane the grid does not have.
    tissue::check(grid_solid(body), body.place);
    fixed_flags(body);
    return body;
}

