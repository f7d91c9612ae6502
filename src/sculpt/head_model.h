// The whole head: all parts over one vertex array, and the landmarks as its vertices.
#pragma once

#include <map>

#include "sculpt/skin.h"

namespace risorius::sculpt {

struct HeadModel {
    geom::PolygonMesh mesh;                           ///< mm
    std::map<std::string, int> landmarks;             ///< id -> vertex
    std::map<std::string, std::vector<int>> regions;  ///< of skin and mouth: name -> faces
};

HeadModel make_head(const DesignTables& tables);

/// OBJ with groups and layout, coordinates to a micrometre; beside it the landmarks, and the regions as runs of faces.
void write_head(const HeadModel& model, const std::filesystem::path& folder);

}  // namespace risorius::sculpt
