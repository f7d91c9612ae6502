// SPDX-License-Identifier: MIT
#include "risorius/scene/landmark_displacements.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/rig/expression_drive.h"

namespace risorius::scene {

LandmarkDisplacements::LandmarkDisplacements(face::Face& face, const rig::RigDescription& rig,
                                             const std::string& place)
    : face_(face), rig_(rig), place_(place), points_(face.head(), rig) {
    static const std::set<std::string> kInner{"brow", "eye", "nose", "lip"};
    for (const rig::AtlasLandmark& landmark : rig.atlas.landmarks)
        if (kInner.count(landmark.region)) ids_.push_back(landmark.id);
    at_rest_.excitation = Eigen::VectorXd::Zero(rig.channels().column_count());
}

track::Drive LandmarkDisplacements::drive(const std::string& expression) const {
    const auto expansion = rig::expansion_at(rig_, expression, 1);
    if (!expansion) throw Error(place_, "an expression of its tables", "\"" + expression + "\"");
    return rig::clamped_drive(*expansion, rig_.channels());
}

Points LandmarkDisplacements::solve_equilibrium(const track::Drive& drive, int iterations,
                                                double tolerance_m) {
    face_.start([&](double) { return at_rest_; });
    in_equilibrium_ =
        face_
            .solve_equilibrium(
                drive.excitation, drive,
                {.iterations = iterations, .tolerance_m = tolerance_m, .planes_m = tolerance_m})
            .converged;
    const Points vertices = face_.pose().vertices;
    Points out(static_cast<long>(ids_.size()), 3);
    for (std::size_t i = 0; i < ids_.size(); ++i)
        out.row(static_cast<long>(i)) =
            (points_.at(ids_[i], vertices) - points_.at(ids_[i], face_.head().vertices))
                .transpose() /
            face_.head().size;
    return out;
}

DisplacementTable read_landmark_displacements(const std::filesystem::path& file) {
    const JsonCursor json = JsonCursor::read_file(file);
    json.at("format").one_of({"risorius-landmark-ways"});
    json.allow_keys({"format", "version", "source", "expressions"});
    json.at("version").integer(1, 1);
    DisplacementTable out;
    const JsonCursor expressions = json.at("expressions");
    for (const std::string& name : expressions.keys())
        for (const std::string& id : expressions.at(name).keys())
            out[name][id] = 1e-3 * expressions.at(name).at(id).vec3();
    return out;
}

Json landmark_displacements_json(const DisplacementTable& ways, const std::string& source) {
    Json json =
        json_object({{"format", "risorius-landmark-ways"}, {"version", 1}, {"source", source}});
    for (const auto& [name, table] : ways)
        for (const auto& [id, way] : table)
            for (int k = 0; k < 3; ++k)
                json["expressions"][name][id].push_back(std::round(1e5 * way[k]) / 100 + 0.0);
    return json;
}

}  // namespace risorius::scene
