// The whole head: all parts over one vertex array, and the landmarks as its vertices.
#pragma once

#include <map>

#include "sculpt/skin.h"

namespace risorius::sculpt {

struct HeadModel {
    geom::PolygonMesh mesh;                ///< mm
    std::map<std::string, int> landmarks;  ///< id -> vertex
};

HeadModel make_head(const DesignTables& tables);

/// OBJ with groups, coordinates to a micrometre; landmark file beside it.
void write_head(const HeadModel& model, const std::filesystem::path& folder);

}  // namespace risorius::sculpt
