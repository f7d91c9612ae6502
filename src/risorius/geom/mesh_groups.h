// SPDX-License-Identifier: MIT
/// \file
/// Divides groups of a mesh by the materials inside of them.
#pragma once

#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::geom {

/// Puts the faces of a group into groups "GROUP.MATERIAL", as glTF names them. Faces without a material stay in the group. When
/// none is left, the group is removed, and the numbers of later groups decrease.
void split_by_material(PolygonMesh& mesh, int group);

/// Splits groups such that the mesh has each of `names` if it can: "Character.Std_eye_l" is the material "Std_eye_l" inside of
/// the group "Character".
void split_as_named(PolygonMesh& mesh, const std::vector<std::string>& names);

/// The names of the materials in each group, in the order of faces.
std::vector<std::vector<std::string>> materials_of_groups(const PolygonMesh& mesh);

/// Removes groups without faces.
void drop_empty_groups(PolygonMesh& mesh);

/// Keeps the faces for which `kept` is true. Vertices stay, also those that no face uses any more.
void keep_faces(PolygonMesh& mesh, const std::vector<bool>& kept);

}  // namespace risorius::geom
