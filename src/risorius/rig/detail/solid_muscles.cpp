// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/solid_muscles.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "risorius/core/json_object.h"

namespace risorius::rig {

namespace {

constexpr int kMaxCells = 32;
constexpr std::pair<std::string_view, std::string_view> kRing{"orbicularis_oris_upper_peripheral",
                                                              "orbicularis_oris_lower_peripheral"};

const Muscle& muscle_named(const JsonCursor& json, const std::string& id,
                           const MuscleTable& table) {
    std::vector<std::string_view> known;
    for (const Muscle& muscle : table.muscles) {
        if (muscle.id == id) return muscle;
        known.push_back(muscle.id);
    }
    const std::string near = nearest_name(id, known);
    json.fail("a muscle of the table of muscles" +
                  (near.empty() ? "" : " (did you mean \"" + near + "\"?)"),
              "\"" + id + "\"");
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
        item.allow_keys({"strength", "width_mm", "thickness_mm", "ends", "cells", "shear_pa",
                         "volume_pa", "source"});
        SolidMuscle solid{
            .muscle = id, .width_m = muscle.width_m, .thickness_m = muscle.thickness_m};
        if (const auto v = item.find("strength")) solid.strength = v->number({0, 100});
        if (const auto v = item.find("width_mm")) solid.width_m = 1e-3 * v->number({0.5, 200});
        if (const auto v = item.find("thickness_mm"))
            solid.thickness_m = 1e-3 * v->number({0.5, 50});
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
        if (const auto v = item.find("shear_pa")) solid.shear_pa = v->number({1, 1e9});
        if (const auto v = item.find("volume_pa")) solid.volume_pa = v->number({1, 1e10});
        out.push_back(solid);
    }
    for (const auto& [half, other] : {kRing, std::pair{kRing.second, kRing.first}})
        if (json.has(half) && !json.has(other))
            json.at(half).fail("the other half of the ring, \"" + std::string(other) + "\", too",
                               "this half alone");
    return out;
}

Json solid_muscles_json(const std::vector<SolidMuscle>& solids) {
    const auto mm = [](double metres) { return std::round(1e9 * metres) / 1e6; };
    Json out = Json::object();
    for (const SolidMuscle& solid : solids)
        out[solid.muscle] = json_object({{"strength", solid.strength},
                                         {"width_mm", mm(solid.width_m)},
                                         {"thickness_mm", mm(solid.thickness_m)},
                                         {"ends", solid.ends},
                                         {"cells", solid.cells},
                                         {"shear_pa", solid.shear_pa},
                                         {"volume_pa", solid.volume_pa}});
    return out;
}

}  // namespace risorius::rig
