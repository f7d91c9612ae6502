// SPDX-License-Identifier: MIT
#include "risorius/softbody/body_description.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "risorius/softbody/detail/read_numbers.h"

namespace risorius::softbody {
namespace {

using detail::kMaxNodesPerAxis;
using detail::not_negative;
using detail::positive;

const std::vector<Quantity>& quantities_of(Kind kind) {
    static const std::vector<Quantity> solid = {
        {"elastic", "elastic_n_per_m3", 3},
        {"damping", "damping_ns_per_m3", 3},
        {"incompressibility", "incompressibility_n_per_m5", 0},
        {"mass", "mass_kg", 0},
        {"drag", "drag_ns_per_m", 0}};
    static const std::vector<Quantity> surface = {{"elastic", "elastic_n_per_m3", 2},
                                                  {"damping", "damping_ns_per_m3", 2},
                                                  {"bending", "bending_n_per_m", 2},
                                                  {"mass", "mass_kg", 0},
                                                  {"drag", "drag_ns_per_m", 0}};
    static const std::vector<Quantity> curve = {{"elastic", "elastic_n_per_m3", 0},
                                                {"damping", "damping_ns_per_m3", 0},
                                                {"bending", "bending_n_per_m", 0},
                                                {"mass", "mass_kg", 0},
                                                {"drag", "drag_ns_per_m", 0}};
    return kind == Kind::kSolid ? solid : kind == Kind::kCurve ? curve : surface;
}

int axes_of(Kind kind) { return kind == Kind::kSolid ? 3 : kind == Kind::kCurve ? 1 : 2; }

Kind read_kind(const JsonCursor& json) {
    const std::string name = json.one_of({"solid", "surface", "cylinder", "curve"});
    return name == "solid"     ? Kind::kSolid
           : name == "surface" ? Kind::kSurface
           : name == "curve"   ? Kind::kCurve
                               : Kind::kCylinder;
}

tissue::GridShape read_grid(const JsonCursor& json, Kind kind) {
    const auto counts = json.items();
    const int axes = axes_of(kind);
    if (static_cast<int>(counts.size()) != axes)
        json.fail(axes == 1 ? "one number of nodes"
                            : std::string(axes == 3 ? "three" : "two") +
                                  " numbers of nodes, one per axis");
    const auto count = [&](std::size_t axis) {
        // Around a tube, two nodes would lie on one line.
        const int min = kind == Kind::kCylinder && axis == 1 ? 3 : 2;
        return counts[axis].integer(min, kMaxNodesPerAxis);
    };
    return {.m = count(0), .n = axes > 1 ? count(1) : 1, .o = axes > 2 ? count(2) : 1};
}

tissue::Parameters read_parameters(const JsonCursor& material, std::string_view key) {
    const auto json = material.find(key);
    if (!json) return tissue::Parameters::kResolutionIndependent;
    return json->one_of({"resolution-independent", "per-node"}) == "per-node"
               ? tissue::Parameters::kPerNode
               : tissue::Parameters::kResolutionIndependent;
}

void read_solid_material(const JsonCursor& json, BodyDescription& body) {
    json.allow_keys({"mass_kg", "elastic_n_per_m3", "damping_ns_per_m3",
                     "incompressibility_n_per_m5", "drag_ns_per_m", "parameters"});
    tissue::SolidMaterial& material = body.material;
    material.mass_kg = positive(json.at("mass_kg"));
    material.elastic_n_per_m3 = read_tensor(json.at("elastic_n_per_m3"), 3);
    if (const auto damping = json.find("damping_ns_per_m3"))
        material.damping_ns_per_m3 = read_tensor(*damping, 3);
    material.incompressibility_n_per_m5 = not_negative(json, "incompressibility_n_per_m5", 0);
    material.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    body.parameters = read_parameters(json, "parameters");
    if (body.parameters == tissue::Parameters::kPerNode &&
        body.discretisation == Discretisation::kCells)
        json.at("parameters").fail("\"resolution-independent\", which is all that cells know");
}

void read_surface_material(const JsonCursor& json, BodyDescription& body) {
    json.allow_keys({"mass_kg", "elastic_n_per_m3", "damping_ns_per_m3", "bending_n_per_m",
                     "drag_ns_per_m", "parameters", "bending_parameters"});
    tissue::SurfaceMaterial& material = body.surface;
    const auto tensor = [](const JsonCursor& entry) -> tissue::Mat2 {
        return read_tensor(entry, 2).topLeftCorner<2, 2>();
    };
    material.mass_kg = positive(json.at("mass_kg"));
    material.elastic_n_per_m3 = tensor(json.at("elastic_n_per_m3"));
    if (const auto damping = json.find("damping_ns_per_m3"))
        material.damping_ns_per_m3 = tensor(*damping);
    if (const auto bending = json.find("bending_n_per_m"))
        material.bending_n_per_m = tensor(*bending);
    material.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    body.parameters = read_parameters(json, "parameters");
    body.bending_parameters = read_parameters(json, "bending_parameters");
}

void read_curve_material(const JsonCursor& json, BodyDescription& body) {
    json.allow_keys({"mass_kg", "elastic_n_per_m3", "damping_ns_per_m3", "bending_n_per_m",
                     "drag_ns_per_m", "parameters"});
    body.curve.mass_kg = positive(json.at("mass_kg"));
    body.curve.elastic_n_per_m3 = not_negative(json.at("elastic_n_per_m3"));
    body.curve.damping_ns_per_m3 = not_negative(json, "damping_ns_per_m3", 0);
    body.curve.bending_n_per_m = not_negative(json, "bending_n_per_m", 0);
    body.curve.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    body.parameters = read_parameters(json, "parameters");
}

Discretisation read_discretisation(const JsonCursor& json, Kind kind) {
    if (kind == Kind::kSolid) {
        const std::string name = json.one_of({"differences", "cells", "bending-cells"});
        return name == "cells"           ? Discretisation::kCells
               : name == "bending-cells" ? Discretisation::kBendingCells
                                         : Discretisation::kDifferences;
    }
    return json.one_of({"differences", "triangles"}) == "triangles" ? Discretisation::kTriangles
                                                                    : Discretisation::kDifferences;
}

void read_irregular(const JsonCursor& json, BodyDescription& body) {
    json.allow_keys({"share", "seed"});
    if (body.discretisation != Discretisation::kTriangles)
        json.fail("\"triangles\" for its discretisation", "another");
    IrregularDescription irregular;
    irregular.fraction = json.at("share").number({0, 0.45});
    if (const auto seed = json.find("seed"))
        irregular.seed = static_cast<unsigned>(seed->integer(0, 1000000));
    body.irregular = irregular;
}

bool has_moduli(const JsonCursor& material) {
    return material.has("shear_pa") || material.has("young_pa") ||
           material.has("density_kg_per_m3");
}

ModuliDescription read_moduli(const JsonCursor& json) {
    json.allow_keys({"shear_pa", "bulk_pa", "young_pa", "poisson_ratio", "density_kg_per_m3",
                     "viscosity_pa_s", "drag_ns_per_m"});
    const bool by_young = json.has("young_pa");
    if (by_young == json.has("shear_pa"))
        json.fail("either \"shear_pa\" and \"bulk_pa\" or \"young_pa\" and \"poisson_ratio\"",
                  by_young ? "both" : "neither");
    ModuliDescription moduli;
    const double stiffness = positive(json.at(by_young ? "young_pa" : "shear_pa"));
    const JsonCursor second = json.at(by_young ? "poisson_ratio" : "bulk_pa");
    try {
        moduli.elastic = by_young ? tissue::moduli_of_young(stiffness, second.number())
                                  : tissue::moduli_of_bulk(stiffness, second.number());
    } catch (const std::invalid_argument&) {
        second.fail(by_young ? "a number in [0, 0.5)"
                             : "at least two thirds of the shear modulus, " +
                                   format_number(2 * stiffness / 3));
    }
    moduli.density_kg_per_m3 = positive(json.at("density_kg_per_m3"));
    moduli.viscosity_pa_s = not_negative(json, "viscosity_pa_s", 0);
    moduli.drag_ns_per_m = not_negative(json, "drag_ns_per_m", 0);
    return moduli;
}

tissue::SolidMaterial material_of_block(const ModuliDescription& moduli, const Vec3& edges_m,
                                        const tissue::GridShape& grid,
                                        Discretisation discretisation) {
    const double volume_m3 = edges_m.prod(), k_pa = moduli.elastic.volume_pa;
    tissue::SolidMaterial material;
    material.elastic_n_per_m3 = tissue::block_tensor(moduli.elastic.shear_pa, edges_m);
    material.damping_ns_per_m3 = tissue::block_tensor(moduli.viscosity_pa_s, edges_m);
    material.incompressibility_n_per_m5 =
        discretisation != Discretisation::kDifferences
            ? tissue::incompressibility(k_pa, volume_m3)
            : tissue::nodal_incompressibility(k_pa, volume_m3, grid);
    material.mass_kg = moduli.density_kg_per_m3 * volume_m3;
    material.drag_ns_per_m = moduli.drag_ns_per_m;
    return material;
}

void change_tensor(Mat3& tensor, const MaterialChange& change, double fraction) {
    tensor = changed(tensor, change, fraction);
}

void change_tensor(double& number, const MaterialChange& change, double fraction) {
    number = changed(number, change, fraction);
}

void change_tensor(tissue::Mat2& tensor, const MaterialChange& change, double fraction) {
    Mat3 whole = Mat3::Zero();
    whole.topLeftCorner<2, 2>() = tensor;
    tensor = changed(whole, change, fraction).topLeftCorner<2, 2>();
}

/// Changes the quantities that all kinds have in common.
template <typename Material>
void change_shared(Material& material, const MaterialChange& change, double fraction) {
    if (change.quantity == "elastic") change_tensor(material.elastic_n_per_m3, change, fraction);
    if (change.quantity == "damping") change_tensor(material.damping_ns_per_m3, change, fraction);
    if (change.quantity == "mass") material.mass_kg = changed(material.mass_kg, change, fraction);
    if (change.quantity == "drag")
        material.drag_ns_per_m = changed(material.drag_ns_per_m, change, fraction);
}

void change_own(tissue::SolidMaterial& material, const MaterialChange& change, double fraction) {
    if (change.quantity == "incompressibility")
        material.incompressibility_n_per_m5 =
            changed(material.incompressibility_n_per_m5, change, fraction);
}

void change_own(tissue::SurfaceMaterial& material, const MaterialChange& change, double fraction) {
    if (change.quantity == "bending") change_tensor(material.bending_n_per_m, change, fraction);
}

void change_own(tissue::CurveMaterial& material, const MaterialChange& change, double fraction) {
    if (change.quantity == "bending") change_tensor(material.bending_n_per_m, change, fraction);
}

/// One material, or one per node when regions change it.
template <typename Material>
std::vector<Material> material_field(const BodyDescription& description, const Material& whole) {
    if (description.regions.empty()) return {whole};
    std::vector<Material> field(static_cast<std::size_t>(description.grid.size()), whole);
    for_each_change(description.regions, description.grid,
                    [&](int node, const MaterialChange& change, double fraction) {
                        Material& material = field[static_cast<std::size_t>(node)];
                        change_shared(material, change, fraction);
                        change_own(material, change, fraction);
                    });
    return field;
}

}  // namespace

BodyDescription read_body(const JsonCursor& json) {
    BodyDescription body;
    body.place = json.place();
    body.kind = read_kind(json.at("kind"));
    std::vector<std::string_view> known = {
        "kind",    "grid",   "rest",     "material", "regions", "fixed", "gravity_m_per_s2",
        "springs", "pulses", "obstacles"};
    if (body.kind != Kind::kCurve) known.push_back("discretisation");
    if (axes_of(body.kind) == 2) known.push_back("irregular");
    json.allow_keys(known);

    body.grid = read_grid(json.at("grid"), body.kind);
    body.rest = read_rest(json.at("rest"), body.kind);
    if (const auto discretisation = json.find("discretisation"))
        body.discretisation = read_discretisation(*discretisation, body.kind);
    if (const auto irregular = json.find("irregular")) read_irregular(*irregular, body);

    const JsonCursor material = json.at("material");
    if (body.kind == Kind::kCurve) {
        read_curve_material(material, body);
    } else if (body.kind != Kind::kSolid) {
        read_surface_material(material, body);
    } else if (has_moduli(material)) {
        if (body.rest.form != RestDescription::Form::kBlock)
            material.fail("lambda, omega and psi where the rest shape is not a block", "moduli");
        body.moduli = read_moduli(material);
        if (body.discretisation == Discretisation::kBendingCells && body.moduli->viscosity_pa_s > 0)
            material.at("viscosity_pa_s").fail("0 for bending cells");
    } else {
        read_solid_material(material, body);
    }

    const int axes = axes_of(body.kind);
    if (const auto regions = json.find("regions"))
        body.regions = read_regions(*regions, quantities_of(body.kind), axes);
    if (const auto fixed = json.find("fixed"))
        for (const JsonCursor& selection : fixed->items())
            body.fixed.push_back(read_node_selection(selection, axes));
    if (const auto gravity = json.find("gravity_m_per_s2")) body.gravity_m_per_s2 = gravity->vec3();
    if (const auto springs = json.find("springs")) body.springs = read_springs(*springs, axes);
    if (const auto pulses = json.find("pulses")) body.pulses = read_pulses(*pulses, axes);
    // Springs and pulses are located on the grid.
    for (const char* key : {"springs", "pulses"})
        if (body.irregular && json.has(key)) json.at(key).fail("none on irregular triangles");
    if (const auto obstacles = json.find("obstacles")) body.obstacles = read_obstacles(*obstacles);

    if (body.discretisation == Discretisation::kBendingCells &&
        (!body.moduli || json.has("regions")))
        json.at("discretisation").fail("moduli as material, and no regions, for bending cells");

    // Some errors show only in the whole: a folded rest shape, or a plane that the grid does not have.
    if (body.kind == Kind::kSolid)
        tissue::check(grid_solid(body), body.place);
    else if (body.kind == Kind::kCurve)
        tissue::check(grid_curve(body), body.place);
    else
        tissue::check(grid_surface(body), body.place);
    if (body.discretisation == Discretisation::kTriangles)
        tissue::check(triangle_surface(body), body.place);
    fixed_flags(body);
    return body;
}

tissue::GridSolid grid_solid(const BodyDescription& description) {
    tissue::GridSolid solid;
    solid.grid = description.grid;
    solid.parameters = description.parameters;
    solid.rest = rest_points(description.rest, description.grid);
    solid.material = material_field(
        description, description.moduli
                         ? material_of_block(*description.moduli, description.rest.edges_m,
                                             description.grid, description.discretisation)
                         : description.material);
    return solid;
}

tissue::GridSurface grid_surface(const BodyDescription& description) {
    tissue::GridSurface surface;
    surface.grid = {.m = description.grid.m,
                    .n = description.grid.n,
                    .closed = description.kind == Kind::kCylinder};
    surface.parameters = description.parameters;
    surface.bending = description.bending_parameters;
    surface.rest = rest_points(description.rest, description.grid);
    surface.material = material_field(description, description.surface);
    return surface;
}

tissue::TriangleSurface triangle_surface(const BodyDescription& description) {
    const tissue::GridSurface surface = grid_surface(description);
    return description.irregular
               ? tissue::irregularly_triangulated(surface, description.irregular->fraction,
                                                  description.irregular->seed)
               : tissue::triangulated(surface);
}

tissue::GridCurve grid_curve(const BodyDescription& description) {
    tissue::GridCurve curve;
    curve.parameters = description.parameters;
    curve.rest = rest_points(description.rest, description.grid);
    curve.material = material_field(description, description.curve);
    return curve;
}

std::vector<double> relative_stiffness(const BodyDescription& description) {
    std::vector<double> stiffness;
    if (description.regions.empty()) return stiffness;
    constexpr double kMin = 1e-300;  // stands for zero
    if (description.kind == Kind::kSolid) {
        for (const tissue::SolidMaterial& material : grid_solid(description).material)
            stiffness.push_back(std::log(std::max(material.elastic_n_per_m3.mean(), kMin)));
        return stiffness;
    }
    if (description.kind == Kind::kCurve) return stiffness;
    bool bending = false;
    for (const MaterialRegion& region : description.regions)
        for (const MaterialChange& change : region.changes)
            bending = bending || change.quantity == "bending";
    for (const tissue::SurfaceMaterial& material : grid_surface(description).material)
        stiffness.push_back(std::log(std::max(
            (bending ? material.bending_n_per_m : material.elastic_n_per_m3).mean(), kMin)));
    return stiffness;
}

std::vector<char> fixed_flags(const BodyDescription& description) {
    std::vector<char> flags(static_cast<std::size_t>(description.grid.size()), 0);
    for (const NodeSelection& selection : description.fixed)
        for (const int node : select(selection, description.grid))
            flags[static_cast<std::size_t>(node)] = 1;
    return flags;
}

}  // namespace risorius::softbody
