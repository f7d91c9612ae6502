// SPDX-License-Identifier: MIT
#include "risorius/softbody/mesh_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "risorius/core/existing_file.h"
#include "risorius/core/known_names.h"
#include "risorius/geom/filled_surface.h"
#include "risorius/geom/tet_boundary.h"
#include "risorius/io/read_mesh.h"
#include "risorius/io/tet_mesh.h"
#include "risorius/softbody/detail/read_numbers.h"
#include "risorius/tissue/coordinate_guides.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/hyperelastic_tets.h"

namespace risorius::softbody {

namespace {

using detail::not_negative;
using detail::positive;

constexpr int kLargestTag = 2'147'483'647;

tissue::Hyperelastic read_law(const JsonCursor& json, std::vector<std::string_view>& keys) {
    tissue::Hyperelastic out;
    const std::string law =
        json.at("law").one_of({"neo-hookean", "mooney-rivlin", "ogden", "fibres"});
    if (law == "ogden") {
        keys.push_back("terms");
        for (const JsonCursor& term : json.at("terms").items()) {
            const std::vector<JsonCursor> pair = term.items();
            if (pair.size() != 2) term.fail("[modulus_pa, exponent]");
            out.ogden.push_back({pair[0].number(), pair[1].number({-100, 100})});
            if (!(out.ogden.back().modulus_pa * out.ogden.back().exponent > 0))
                term.fail("a modulus and an exponent with the same sign, neither 0");
        }
        if (out.ogden.empty()) json.at("terms").fail("at least one term", "none");
    } else {
        keys.push_back("c10_pa");
        out.c10_pa = positive(json.at("c10_pa"));
    }
    if (law == "mooney-rivlin" || law == "fibres") {
        keys.push_back("c01_pa");
        out.c01_pa =
            law == "fibres" ? not_negative(json, "c01_pa", 0) : not_negative(json.at("c01_pa"));
    }
    if (law == "fibres") {
        for (const char* key : {"c3_pa", "c4", "c5_pa", "straight"}) keys.push_back(key);
        if (!json.has("muscle")) keys.push_back("along");
        out.fibres.c3_pa = positive(json.at("c3_pa"));
        out.fibres.c4 = json.at("c4").number({1e-3, 100});
        out.fibres.c5_pa = not_negative(json.at("c5_pa"));
        out.fibres.straight = json.at("straight").number({1.001, 10});
    }
    out.bulk_pa = positive(json.at("bulk_pa"));
    return out;
}

MeshRegion read_region(const JsonCursor& json) {
    MeshRegion out;
    std::vector<std::string_view> keys{"tags",  "names", "law", "bulk_pa", "density_kg_per_m3",
                                       "muscle"};
    out.place = json.place();
    out.material = read_law(json, keys);
    json.allow_keys(keys);
    if (const auto tags = json.find("tags"))
        for (const JsonCursor& tag : tags->items())
            out.tags.push_back(tag.integer(-kLargestTag, kLargestTag));
    if (const auto names = json.find("names"))
        for (const JsonCursor& name : names->items()) out.names.push_back(name.string());
    out.density_kg_per_m3 = positive(json.at("density_kg_per_m3"));
    if (const auto muscle = json.find("muscle")) {
        out.muscle = read_mesh_muscle(*muscle);
    } else if (out.material.fibres.c3_pa > 0) {
        out.along = json.at("along").vec3();
        if (!(out.along.norm() > 0)) json.at("along").fail("a direction");
        out.along.normalize();
    }
    return out;
}

io::TetMesh tets_of(const MeshBodyDescription& description) {
    io::TetMesh mesh = io::read_tet_mesh(description.file);
    mesh.positions *= description.metres_per_unit;
    return mesh;
}

/// "x", "xy" and the like.
std::array<bool, 3> read_axes(const JsonCursor& json) {
    std::array<bool, 3> out{};
    for (const char letter : json.string()) {
        const int axis = letter - 'x';
        if (axis < 0 || axis > 2 || out[static_cast<std::size_t>(axis)])
            json.fail("some of the letters x, y and z, each once");
        out[static_cast<std::size_t>(axis)] = true;
    }
    if (json.string().empty()) json.fail("some of the letters x, y and z, each once");
    return out;
}

/// A number for all muscles, or one for each.
std::vector<double> read_activation(const JsonCursor& json,
                                    const std::vector<MeshRegion>& regions) {
    std::size_t muscles = 0;
    for (const MeshRegion& region : regions) muscles += region.muscle.has_value();
    const auto given = json.find("activation");
    if (!given) return std::vector<double>(muscles, 0.0);
    if (muscles == 0) given->fail("none, since no material is a muscle");
    if (!given->is_array()) return std::vector<double>(muscles, given->number({0, 1}));
    std::vector<double> out;
    for (const JsonCursor& one : given->items()) out.push_back(one.number({0, 1}));
    if (out.size() != muscles)
        given->fail("as many numbers as materials are muscles, " + std::to_string(muscles),
                    std::to_string(out.size()));
    return out;
}

/// The tetrahedra inside of a surface.
io::TetMesh filled(const MeshBodyDescription& description) {
    const geom::PolygonMesh surface =
        io::read_mesh(description.file, {.metres_per_unit = description.metres_per_unit});
    geom::NotFilled why{};
    geom::FilledSurface solid = geom::fill_with_tets(surface.positions, geom::triangulate(surface),
                                                     description.spacing_m, why);
    const std::string place = description.place + "/mesh/",
                      name = in_quotes(description.file.string());
    if (why == geom::NotFilled::kOpen)
        throw Error(place + "surface", "a closed surface with two polygons at every edge", name);
    if (why == geom::NotFilled::kInsideOut)
        throw Error(place + "surface", "a surface that faces outward", name);
    if (why == geom::NotFilled::kTooFine)
        throw Error(place + "spacing_m",
                    "at most " + std::to_string(static_cast<long>(geom::kMostFillingCubes)) +
                        " cubes around the surface",
                    format_number(description.spacing_m));
    if (why == geom::NotFilled::kTooCoarse)
        throw Error(place + "spacing_m", "tetrahedra with their middle inside the surface",
                    format_number(description.spacing_m));
    io::TetMesh mesh;
    mesh.positions = std::move(solid.nodes);
    mesh.tets = std::move(solid.tets);
    mesh.tags.assign(static_cast<std::size_t>(mesh.tets.rows()), 0);
    return mesh;
}

/// The material of each tetrahedron.
std::vector<int> assign(const MeshBodyDescription& description, const io::TetMesh& mesh) {
    std::map<int, int> region_of_tag;
    int rest = -1;
    std::vector<std::string> names;
    for (const auto& [name, tag] : mesh.names) names.push_back(name);
    const std::set<int> known(mesh.tags.begin(), mesh.tags.end());
    for (std::size_t r = 0; r < description.regions.size(); ++r) {
        const MeshRegion& region = description.regions[r];
        const auto add = [&](int tag) {
            if (!known.count(tag))
                throw Error(region.place, "tags of " + description.file.string(),
                            std::to_string(tag));
            if (!region_of_tag.emplace(tag, static_cast<int>(r)).second)
                throw Error(region.place, "tags that no other material has", std::to_string(tag));
        };
        for (const int tag : region.tags) add(tag);
        for (const std::string& name : region.names)
            add(mesh.names.at(names[index_of_name(region.place + "/names", name, names)]));
        if (!region.is_rest()) continue;
        if (rest >= 0)
            throw Error(region.place, "\"tags\" or \"names\" in all materials but one", "neither");
        rest = static_cast<int>(r);
    }
    std::vector<int> out;
    for (const int tag : mesh.tags) {
        const auto found = region_of_tag.find(tag);
        if (found == region_of_tag.end() && rest < 0)
            throw Error(description.place + "/materials", "a material for every tag",
                        "none for " + std::to_string(tag));
        out.push_back(found == region_of_tag.end() ? rest : found->second);
    }
    return out;
}

std::vector<std::array<int, 2>> edges_of(const Tets& tets) {
    std::set<std::array<int, 2>> edges;
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < a; ++b) {
                const auto [low, high] = std::minmax(tets(t, a), tets(t, b));
                edges.insert({low, high});
            }
    return {edges.begin(), edges.end()};
}

std::vector<SoftBody::Support> supports_of(const MeshBodyDescription& description,
                                           const Points& rest) {
    std::vector<SoftBody::Support> out;
    for (std::size_t b = 0; b < description.fixed.size(); ++b) {
        const FixedBox& fixed = description.fixed[b];
        SoftBody::Support support{.axes = fixed.axes};
        for (Eigen::Index i = 0; i < rest.rows(); ++i)
            if (fixed.box.holds(rest.row(i).transpose()))
                support.nodes.push_back(static_cast<int>(i));
        if (support.nodes.empty())
            throw Error(description.place + "/fixed/" + std::to_string(b), "a box with nodes in it",
                        "none");
        out.push_back(std::move(support));
    }
    return out;
}

/// The muscles, and in `fibres` the directions of their tetrahedra.
std::vector<std::shared_ptr<muscle::FibreTets>> muscles_of(const MeshBodyDescription& description,
                                                           const io::TetMesh& mesh,
                                                           const std::vector<int>& material_of,
                                                           Points& fibres) {
    std::vector<std::shared_ptr<muscle::FibreTets>> out;
    for (std::size_t r = 0; r < description.regions.size(); ++r) {
        const auto& muscle = description.regions[r].muscle;
        if (!muscle) continue;
        std::vector<int> tets;
        for (std::size_t t = 0; t < material_of.size(); ++t)
            if (material_of[t] == static_cast<int>(r)) tets.push_back(static_cast<int>(t));
        const Points along = fibre_directions(*muscle, mesh, tets);
        fibres(tets, Eigen::all) = along;
        out.push_back(std::make_shared<muscle::FibreTets>(
            muscle->parameters, mesh.positions, mesh.tets(tets, Eigen::all), along,
            [a = description.activation[out.size()]](double) { return a; }));
    }
    return out;
}

/// Stiffness of the springs that hold sliding nodes: far above that of the body.
double guide_stiffness(const MeshBodyDescription& description, double length_m) {
    double stiffest = 0;
    for (const MeshRegion& region : description.regions)
        stiffest =
            std::max(stiffest, 4.0 / 3 * region.material.shear_pa() + region.material.bulk_pa +
                                   (region.muscle ? region.muscle->parameters.tension_pa : 0));
    return 1e5 * stiffest * length_m;
}

}  // namespace

bool is_mesh_body(const JsonCursor& json) {
    const auto kind = json.find("kind");
    return kind && kind->is_string() && kind->string() == "mesh";
}

MeshBodyDescription read_mesh_body(const JsonCursor& json) {
    json.allow_keys({"kind", "mesh", "materials", "fixed", "gravity_m_per_s2", "activation"});
    json.at("kind").one_of({"mesh"});
    MeshBodyDescription out;
    out.place = json.place();
    if (out.place.ends_with('/')) out.place.pop_back();  // the top of a document
    const JsonCursor mesh = json.at("mesh");
    const bool surface = mesh.has("surface");
    mesh.allow_keys(surface
                        ? std::vector<std::string_view>{"surface", "spacing_m", "metres_per_unit"}
                        : std::vector<std::string_view>{"file", "metres_per_unit"});
    out.file = existing_file(mesh.at(surface ? "surface" : "file"));
    if (surface) out.spacing_m = mesh.at("spacing_m").number({1e-9, 1e3});
    if (const auto unit = mesh.find("metres_per_unit"))
        out.metres_per_unit = unit->number({1e-9, 1e3});
    for (const JsonCursor& region : json.at("materials").items())
        out.regions.push_back(read_region(region));
    if (out.regions.empty()) json.at("materials").fail("at least one material", "none");
    if (const auto fixed = json.find("fixed"))
        for (const JsonCursor& box : fixed->items()) {
            box.allow_keys({"low_m", "high_m", "axes"});
            out.fixed.push_back({read_box(box)});
            if (const auto axes = box.find("axes")) out.fixed.back().axes = read_axes(*axes);
        }
    if (const auto gravity = json.find("gravity_m_per_s2")) out.gravity_m_per_s2 = gravity->vec3();
    out.activation = read_activation(json, out.regions);
    return out;
}

SoftBody build_mesh_body(const MeshBodyDescription& description) {
    const io::TetMesh mesh = description.spacing_m > 0 ? filled(description) : tets_of(description);
    tissue::HyperelasticBody matter;
    matter.rest = mesh.positions;
    matter.tets = mesh.tets;
    matter.material_of = assign(description, mesh);
    matter.fibres.resize(mesh.tets.rows(), 3);
    for (const MeshRegion& region : description.regions)
        matter.materials.push_back(region.material);
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        matter.fibres.row(t) =
            description
                .regions[static_cast<std::size_t>(matter.material_of[static_cast<std::size_t>(t)])]
                .along.transpose();
    const auto muscles = muscles_of(description, mesh, matter.material_of, matter.fibres);
    auto term = std::make_shared<tissue::HyperelasticTets>(std::move(matter));
    const tissue::HyperelasticBody& built = term->body();

    Eigen::VectorXd mass_kg = Eigen::VectorXd::Zero(built.rest.rows());
    for (Eigen::Index t = 0; t < built.tets.rows(); ++t) {
        const auto region =
            static_cast<std::size_t>(built.material_of[static_cast<std::size_t>(t)]);
        const double share =
            term->rest_volumes()[t] * description.regions[region].density_kg_per_m3 / 4;
        for (int k = 0; k < 4; ++k) mass_kg[built.tets(t, k)] += share;
    }
    std::vector<SoftBody::Support> supports = supports_of(description, built.rest);
    std::vector<char> fixed(static_cast<std::size_t>(built.rest.rows()), 0);
    std::vector<tissue::CoordinateGuides::Guide> guides;
    for (const SoftBody::Support& support : supports)
        for (const int node : support.nodes) {
            if (support.whole()) fixed[static_cast<std::size_t>(node)] = 1;
            for (int axis = 0; axis < 3 && !support.whole(); ++axis)
                if (support.axes[static_cast<std::size_t>(axis)])
                    guides.push_back({node, axis, built.rest(node, axis)});
        }
    const double length_m =
        (built.rest.colwise().maxCoeff() - built.rest.colwise().minCoeff()).maxCoeff();
    const auto slides =
        std::make_shared<tissue::CoordinateGuides>(guides, guide_stiffness(description, length_m));
    solve::MotionSystem system(mass_kg, fixed);
    system.add(term);
    for (const auto& muscle : muscles) system.add(muscle);
    if (!guides.empty()) system.add(slides);
    system.add(std::make_shared<tissue::Gravity>(mass_kg, description.gravity_m_per_s2));
    SoftBody body{.kind = Kind::kSolid,
                  .grid = {0, 0, 0},
                  .rest = built.rest,
                  .system = std::move(system),
                  .length_scale_m = length_m,
                  .surface = geom::boundary_of(built.tets),
                  .wires = edges_of(built.tets),
                  .tets = term,
                  .muscles = muscles,
                  .supports = std::move(supports),
                  .slides = slides};
    body.weight_n = mass_kg.sum() * description.gravity_m_per_s2.norm();
    for (std::size_t i = 0; i < fixed.size(); ++i)
        if (fixed[i]) body.fixed.push_back(static_cast<int>(i));
    return body;
}

}  // namespace risorius::softbody
