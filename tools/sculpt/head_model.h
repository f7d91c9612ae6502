// The whole head: all parts over one vertex array, and the landmarks as its vertices.
#pragma once

#include <map>

#include "skin.h"

namespace risorius::sculpt {

struct HeadModel {
    geom::PolygonMesh mesh;                ///< mm
    std::map<std::string, int> landmarks;  ///< id -> vertex
};

HeadModel make_head(const DesignTables& tables);

/// OBJ with groups, coordinates to a micrometre; landmark file beside it.
void write_head(const HeadModel& model, const std::filesystem::path& folder);

/// How well the head meets the tables, as text.
std::string fit_report(const HeadModel& model, const DesignTables& tables);

}  // namespace risorius::sculpt
