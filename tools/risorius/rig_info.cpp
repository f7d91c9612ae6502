// SPDX-License-Identifier: MIT
#include "tools/risorius/rig_info.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_force.h"
#include "risorius/scene/rig_files.h"
#include "tools/risorius/stop_signals.h"

namespace risorius::cli {

namespace {

Json parts_of(const scene::RigFiles& files) {
    Json out = Json::object();
    for (const auto& [role, groups] : files.rig.parts)
        for (const std::string& group : groups) {
            const int index = files.mesh.group_index(group);
            out[role][group] =
                std::count(files.mesh.face_group.begin(), files.mesh.face_group.end(), index);
        }
    return out;
}

Json muscles_of(const rig::RigDescription& rig, double size) {
    Json out = Json::array();
    for (const rig::Muscle& muscle : rig.muscles.muscles) {
        const rig::MuscleForce force = rig::muscle_force(rig, muscle, size);
        Json entry = json_object({{"id", muscle.id},
                                  {"name", muscle.name},
                                  {"group", muscle.group},
                                  {"paired", muscle.paired},
                                  {"action", muscle.action},
                                  {"min", muscle.tonic ? -1.0 : 0.0},
                                  {"bands", rig::bands_of(rig.atlas, muscle.id)},
                                  {"simulated_as", rig::name_of(force.model)}});
        if (muscle.group == "jaw" || muscle.group == "hyoid")
            entry["moves_jaw"] = true;  // when a script says "jaw": "muscles"
        if (force.model != rig::MuscleModel::kNone) {
            entry["greatest_force_n"] = force.greatest_n;
            entry["table_n"] = force.table_n;
            entry["strength"] = force.strength;
            entry["factor"] = force.factor;
        }
        out.push_back(entry);
    }
    return out;
}

/// How stiff the tissue around each volume muscle is. It needs the face, which takes a second.
Json beside_solids(const scene::RigFiles& files) {
    const face::Face face(files.rig, files.mesh, face::quality_named("draft"), files.place());
    Json out = Json::array();
    for (const face::BesideSolid& solid : face.diagnostics().beside_solids())
        out.push_back(json_object({{"muscle", solid.muscle},
                                   {"side", solid.side == Side::kLeft ? "l" : "r"},
                                   {"nodes_in_tissue", solid.nodes},
                                   {"tissue_shear_pa", solid.tissue_pa},
                                   {"softest_pa", solid.softest_pa},
                                   {"muscle_shear_pa", solid.muscle_pa},
                                   {"beside_solids_ratio", solid.ratio()}}));
    return out;
}

}  // namespace

Json rig_info(const std::filesystem::path& rig_file) {
    const scene::RigFiles files = scene::read_rig_files(rig_file, stop_is_asked);
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    Json out;
    out["name"] = files.rig.name;
    out["mesh"] = json_object({{"file", files.rig.mesh_file.generic_string()},
                               {"vertices", files.mesh.vertex_count()},
                               {"faces", files.mesh.face_count()},
                               {"metres_per_unit", files.rig.metres_per_unit}});
    out["parts"] = parts_of(files);
    out["size"] = head.size;
    out["residual_mm"] = 1e3 * head.frame.residual_m;
    out["landmarks"] = json_object(
        {{"given", files.rig.landmarks.size()}, {"placed_by_the_atlas", head.warped_landmarks}});
    out["muscles"] = muscles_of(files.rig, head.size);
    out["beside_solids"] = files.rig.solids.empty() ? Json::array() : beside_solids(files);
    out["columns"] = files.rig.channels().column_count();
    out["action_units"] = Json::array();
    for (const track::ActionUnit& unit : files.rig.facs.units)
        if (unit.unsupported.empty())
            out["action_units"].push_back(
                json_object({{"id", unit.id}, {"name", unit.name}, {"sided", unit.sided}}));
    out["expressions"] = Json::array();
    for (const track::Expression& expression : files.rig.expressions.list)
        out["expressions"].push_back(expression.name);
    out["arkit"] = Json::array();
    for (const track::ArkitShape& shape : files.rig.facs.arkit) out["arkit"].push_back(shape.name);
    out["kinematic"] = Json::array();
    for (const track::KinematicChannel& channel : track::kinematic_channels())
        out["kinematic"].push_back(json_object(
            {{"name", std::string(channel.name)}, {"min", channel.min}, {"max", channel.max}}));
    return out;
}

}  // namespace risorius::cli
