// SPDX-License-Identifier: MIT
/// \file
/// A mesh as its file gives it: polygons of any size over shared vertices, with faces in named groups. The vertices have the
/// order of the file, so that tables of displacements by vertex index remain valid.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// A picture that colours faces.
struct Texture {
    std::filesystem::path file;
    std::string named_in;  ///< the place that names it, for messages: "head.mtl:7"
    /// The bytes of the picture's file, when it is stored inside the mesh's file.
    std::vector<std::uint8_t> embedded;
};

/// V vertices, F faces and C corners. Positions are in metres once a mesh is read.
struct PolygonMesh {
    Points positions;  ///< V x 3
    /// F + 1; the corners of face f are [face_begin[f], face_begin[f+1])
    std::vector<int> face_begin{0};
    std::vector<int> corner_vertex;  ///< C, vertex index of each corner
    TexCoords corner_texcoord;       ///< C x 2, or 0 rows when the file has none
    std::vector<int> face_group;     ///< F, index into group_names
    std::vector<std::string> group_names;
    /// The files need not exist; they are read only when colours are needed.
    std::vector<Texture> textures;
    /// F; index into textures or -1; empty when there are no textures.
    std::vector<int> face_texture;
    /// Materials inside of groups, see split_by_material(). Both are empty where the file has none, or groups are materials.
    std::vector<std::string> material_names;
    std::vector<int> face_material;  ///< F; index into material_names or -1
    /// False: the importer of this format did not give the order of vertices in the file.
    bool in_file_order = true;
    /// Maps coordinates as they stand in the file to `positions`: the unit and the axes that the file states
    Eigen::Matrix4d from_file = Eigen::Matrix4d::Identity();
    /// What the reader left out or could not find, each a sentence with its place, for a person
    std::vector<std::string> notes;

    int vertex_count() const { return static_cast<int>(positions.rows()); }
    int face_count() const { return static_cast<int>(face_begin.size()) - 1; }
    int corner_count(int face) const { return face_begin[face + 1] - face_begin[face]; }
    int group_index(const std::string& name) const {  ///< -1 when there is none
        for (std::size_t i = 0; i < group_names.size(); ++i)
            if (group_names[i] == name) return static_cast<int>(i);
        return -1;
    }
};

/// Fan triangles of the faces whose group is listed (of all faces when `groups` is empty), in the order of faces, F x 3. A quad
/// is cut along its shorter diagonal at the mesh's own positions. `corners`, when given, receives F x 3 corner indices for
/// texture coordinates.
Triangles triangulate(const PolygonMesh& mesh, const std::vector<int>& groups = {},
                      Triangles* corners = nullptr);

}  // namespace risorius::geom
