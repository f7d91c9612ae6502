// SPDX-License-Identifier: MIT
#include "risorius/scene/rig_files.h"

#include "risorius/core/error.h"
#include "risorius/geom/mesh_groups.h"
#include "risorius/io/read_mesh.h"

namespace risorius::scene {

geom::MeshReport check_skin(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                            const std::string& advice) {
    geom::MeshCheckOptions options;
    options.metres_per_unit = rig.metres_per_unit;
    const auto skin = rig.parts.find("skin");
    if (skin != rig.parts.end())
        for (const std::string& group : skin->second) {
            const int index = mesh.group_index(group);
            if (index >= 0) options.groups.push_back(index);
        }
    geom::PolygonMesh metres = mesh;
    metres.positions *= rig.metres_per_unit;
    const geom::MeshReport report = geom::inspect_mesh(metres, rig.mesh_file.string(), options);
    for (const geom::MeshFinding& finding : report.findings)
        if (finding.severity == geom::Severity::kError)
            throw Error(finding.place, finding.expected,
                        finding.found + (geom::can_be_repaired(finding.check) ? advice : ""));
    return report;
}

RigFiles read_rig_files(const std::filesystem::path& rig_file) {
    RigFiles files;
    files.file = rig_file;
    files.rig = rig::read_rig(rig_file);
    files.mesh = io::read_mesh(files.rig.mesh_file);
    // Parts may be materials inside of a group.
    for (const auto& [role, groups] : files.rig.parts) geom::split_as_named(files.mesh, groups);
    check_skin(files.rig, files.mesh);
    return files;
}

}  // namespace risorius::scene
