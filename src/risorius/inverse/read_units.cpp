// SPDX-License-Identifier: MIT
#include "risorius/inverse/read_units.h"

#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

namespace {

Json lengths_json(const scene::FaceLengths& lengths) {
    return {{"lid_aperture_mm", lengths.lid_aperture},
            {"mouth_width_mm", lengths.mouth_width},
            {"lip_gap_mm", lengths.lip_gap},
            {"corner_height_mm", lengths.corner_height}};
}

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Json UnitReadings::json() const {
    Json list = Json::array();
    for (const scene::UnitReading& one : units) {
        Json marks = Json::object();
        for (const scene::LandmarkReading& mark : one.landmarks)
            marks[mark.landmark] = {{"target_mm", vector_json(mark.target_mm)},
                                    {"moved_mm", vector_json(mark.moved_mm)},
                                    {"gain", mark.gain}};
        list.push_back({{"unit", one.unit},
                        {"name", one.name},
                        {"gain", one.gain},
                        {"response", one.response},
                        {"change", lengths_json(one.change)},
                        {"landmarks", marks},
                        {"in_equilibrium", one.in_equilibrium}});
    }
    return {{"format", "risorius-unit-readings"},
            {"version", 1},
            {"rig", rig},
            {"neutral", lengths_json(neutral)},
            {"units", list}};
}

UnitReadings read_units(const std::filesystem::path& rig, const std::vector<std::string>& only,
                        const std::string& quality, const ProgressMonitor& monitor) {
    const scene::RigFiles files = scene::read_rig_files(rig);
    std::vector<const track::ActionUnit*> units;
    for (const std::string& id : only) {
        const track::ActionUnit* unit = files.rig.facs.find(id);
        if (!unit || unit->landmark_targets_mm.empty())
            throw Error(files.place(), "an action unit with landmark targets", "\"" + id + "\"");
        units.push_back(unit);
    }
    if (only.empty())
        for (const track::ActionUnit& unit : files.rig.facs.units)
            if (!unit.landmark_targets_mm.empty() && unit.unsupported.empty())
                units.push_back(&unit);
    face::Face face(files.rig, files.mesh, face::quality_named(quality), files.place());
    scene::UnitReader reader(face, files.rig);
    UnitReadings out{rig.generic_string(), reader.lengths(reader.neutral()), {}};
    for (const track::ActionUnit* unit : units) {
        monitor.report(static_cast<double>(out.units.size()) / static_cast<double>(units.size()),
                       unit->id);
        out.units.push_back(reader.read(*unit));
    }
    return out;
}

}  // namespace risorius::inverse
