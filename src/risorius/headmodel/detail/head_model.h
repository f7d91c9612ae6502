// The whole head: all parts over one vertex array, and the landmarks as its vertices.
#pragma once

#include <map>

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {

struct HeadModel {
    geom::PolygonMesh mesh;                           ///< mm
    std::map<std::string, int> landmarks;             ///< id -> vertex
    std::map<std::string, std::vector<int>> regions;  ///< of skin and mouth: name -> faces
    std::vector<double> crown_height;                 ///< V: of teeth, see crown_heights(); else 0
};

HeadModel make_head(const DesignTables& tables);

/// OBJ with groups and layout, coordinates to a micrometre; beside it the landmarks, and the regions as runs of faces. With the name of
/// a material library, which is not written, each group is of the material with its name, and vertices have normals.
void write_head(const HeadModel& model, const std::filesystem::path& folder,
                const std::string& library = {});

}  // namespace risorius::headmodel
