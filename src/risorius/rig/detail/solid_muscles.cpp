// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/solid_muscles.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "risorius/core/existing_file.h"
#include "risorius/core/json_object.h"
#include "risorius/core/known_names.h"

namespace risorius::rig {

namespace {

constexpr int kMaxCells = 32;
constexpr Eigen::Index kMostBellyTets = 5000;  // their second derivative couples all nodes
constexpr std::pair<std::string_view, std::string_view> kRing{"orbicularis_oris_upper_peripheral",
                                                              "orbicularis_oris_lower_peripheral"};

const Muscle& muscle_named(const JsonCursor& json, const std::string& id,
                           const MuscleTable& table) {
    std::vector<std::string> known;
    for (const Muscle& muscle : table.muscles) {
        if (muscle.id == id) return muscle;
        known.push_back(muscle.id);
    }
    json.fail("a muscle of the table of muscles" + did_you_mean(id, known), "\"" + id + "\"");
}

std::shared_ptr<const io::TetMesh> read_belly(const JsonCursor& named) {
    auto mesh = std::make_shared<const io::TetMesh>(io::read_tet_mesh(existing_file(named)));
    if (mesh->tets.rows() > kMostBellyTets)
        named.fail("a mesh with at most " + std::to_string(kMostBellyTets) + " tetrahedra",
                   std::to_string(mesh->tets.rows()));
    return mesh;
}

SolidMesh read_solid_mesh(const JsonCursor& json, const Muscle& muscle) {
    json.allow_keys({"file", "right_file", "metres_per_unit", "along", "ends"});
    if (muscle.id == kRing.first || muscle.id == kRing.second)
        json.fail("no mesh: both halves of the ring are one solid", "a mesh");
    SolidMesh out;
    out.file = existing_file(json.at("file"));
    out.left = read_belly(json.at("file"));
    if (const auto right = json.find("right_file")) {
        if (!muscle.paired) right->fail("one mesh: the muscle has no sides", "a second one");
        out.right_file = existing_file(*right);
        out.right = read_belly(*right);
    }
    if (const auto unit = json.find("metres_per_unit"))
        out.metres_per_unit = unit->number({1e-9, 1e3});
    if (const auto along = json.find("along")) {
        out.along = along->vec3();
        if (!(out.along->norm() > 0)) along->fail("a direction");
        out.along->normalize();
    }
    if (const auto ends = json.find("ends")) {
        const auto both = ends->items();
        if (both.size() != 2) ends->fail("two fractions, of the origin and the insertion");
        for (std::size_t i = 0; i < 2; ++i) out.ends[i] = both[i].number({0.01, 0.4});
    }
    return out;
}

/// Reads what a grid has and a mesh has not.
void read_grid(const JsonCursor& item, SolidMuscle& solid) {
    if (const auto v = item.find("width_mm")) solid.width_m = 1e-3 * v->number({0.5, 200});
    if (const auto v = item.find("thickness_mm")) solid.thickness_m = 1e-3 * v->number({0.5, 50});
    if (const auto v = item.find("ends")) {
        const auto ends = v->items();
        if (ends.size() != 2) v->fail("two ratios, of the origin and the insertion");
        for (std::size_t i = 0; i < 2; ++i) solid.ends[i] = ends[i].number({0.1, 5});
    }
    if (const auto v = item.find("cells")) {
        const auto cells = v->items();
        if (cells.size() != 3) v->fail("three numbers: cells along, across and through");
        for (std::size_t i = 0; i < 3; ++i) solid.cells[i] = cells[i].integer(0, kMaxCells);
    }
}

}  // namespace

std::vector<SolidMuscle> read_solid_muscles(JsonCursor json, const MuscleTable& table) {
    std::vector<SolidMuscle> out;
    for (const std::string& id : json.keys()) {
        const JsonCursor item = json.at(id);
        const Muscle& muscle = muscle_named(item, id, table);
        if (muscle.group != "mimetic" && muscle.group != "jaw")
            item.fail("a muscle of the face or the jaw",
                      "\"" + id + "\", of the group " + muscle.group);
        if (muscle.paths.empty()) item.fail("a muscle with a path", "\"" + id + "\"");
        std::vector<std::string_view> keys{
            "strength", "shear_pa", "shear_along_pa", "stretch_along_pa", "volume_pa",
            "source",   "mesh"};
        if (!item.has("mesh"))
            for (const char* key : {"width_mm", "thickness_mm", "ends", "cells"})
                keys.push_back(key);
        item.allow_keys(keys);
        SolidMuscle solid{
            .muscle = id, .width_m = muscle.width_m, .thickness_m = muscle.thickness_m, .mesh = {}};
        if (const auto v = item.find("strength")) solid.strength = v->number({0, 100});
        if (const auto v = item.find("mesh"))
            solid.mesh = read_solid_mesh(*v, muscle);
        else
            read_grid(item, solid);
        if (const auto v = item.find("shear_pa")) solid.shear_pa = v->number({1, 1e9});
        solid.shear_along_pa = solid.shear_pa;
        if (const auto v = item.find("shear_along_pa")) {
            solid.shear_along_pa = v->number({1, 1e9});
            if (solid.shear_along_pa < solid.shear_pa)
                v->fail("no less than shear_pa, " + format_number(solid.shear_pa));
        }
        if (const auto v = item.find("stretch_along_pa"))
            solid.stretch_along_pa = v->number({0, 1e9});
        if (const auto v = item.find("volume_pa")) solid.volume_pa = v->number({1, 1e10});
        out.push_back(solid);
    }
    for (const auto& [half, other] : {kRing, std::pair{kRing.second, kRing.first}})
        if (json.has(half) && !json.has(other))
            json.at(half).fail("the other half of the ring, \"" + std::string(other) + "\", too",
                               "this half alone");
    return out;
}

Json solid_muscles_json(const std::vector<SolidMuscle>& solids,
                        const std::function<std::string(const std::filesystem::path&)>& name) {
    const auto file = [&](const std::filesystem::path& path) {
        return name ? name(path) : std::filesystem::absolute(path).generic_string();
    };
    const auto mesh_json = [&](const SolidMesh& mesh) {
        Json out = json_object({{"file", file(mesh.file)}, {"ends", mesh.ends}});
        if (!mesh.right_file.empty()) out["right_file"] = file(mesh.right_file);
        if (mesh.metres_per_unit > 0) out["metres_per_unit"] = mesh.metres_per_unit;
        if (mesh.along) out["along"] = {mesh.along->x(), mesh.along->y(), mesh.along->z()};
        return out;
    };
    const auto mm = [](double metres) { return std::round(1e9 * metres) / 1e6; };
    Json out = Json::object();
    for (const SolidMuscle& solid : solids) {
        Json& entry = out[solid.muscle];
        entry["strength"] = solid.strength;
        if (solid.mesh) {
            entry["mesh"] = mesh_json(*solid.mesh);
        } else {
            entry["width_mm"] = mm(solid.width_m);
            entry["thickness_mm"] = mm(solid.thickness_m);
            entry["ends"] = solid.ends;
            entry["cells"] = solid.cells;
        }
        entry["shear_pa"] = solid.shear_pa;
        // Rigs that ask for nothing along the fibres stay as they were
        if (solid.shear_along_pa != solid.shear_pa) entry["shear_along_pa"] = solid.shear_along_pa;
        if (solid.stretch_along_pa != 0) entry["stretch_along_pa"] = solid.stretch_along_pa;
        entry["volume_pa"] = solid.volume_pa;
    }
    return out;
}

}  // namespace risorius::rig
