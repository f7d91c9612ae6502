// SPDX-License-Identifier: MIT
/// \file
/// The complete head: all parts over one vertex array, with the landmarks as vertices.
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
/// The same without texture coordinates, which only files need.
HeadModel make_form(const DesignTables& tables);

/// Writes an OBJ with groups and texture coordinates, to a micrometre, and next to it the landmarks and the regions as ranges of faces. With
/// the name of a material library (which is not written), each group has the material of its name, and vertices have normals.
void write_head(const HeadModel& model, const std::filesystem::path& folder,
                const std::string& library = {});

}  // namespace risorius::headmodel
