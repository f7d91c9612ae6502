// SPDX-License-Identifier: MIT
/// \file
/// A mesh as its file gives it: polygons of any size over shared vertices, with faces in named groups. The vertex order is that of the file,
/// so that displacement tables by vertex index remain valid.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// A picture that gives faces their colour.
struct Texture {
    std::filesystem::path file;
    std::string named_in;  ///< place that names it, for messages: "head.mtl:7"
    std::vector<std::uint8_t>
        embedded;  ///< the picture's file itself where it lies within the mesh's
};

struct PolygonMesh {
    Points positions;  ///< V x 3
    std::vector<int> face_begin{
        0};  ///< F + 1; corners of face f are [face_begin[f], face_begin[f+1])
    std::vector<int> corner_vertex;  ///< C, vertex index of each corner
    TexCoords corner_texcoord;       ///< C x 2, or 0 rows when the file has none
    std::vector<int> face_group;     ///< F, index into group_names
    std::vector<std::string> group_names;
    std::vector<Texture>
        textures;  ///< the files need not exist; they are read only when colours are needed
    std::vector<int> face_texture;  ///< F, into textures or -1; empty when there are none

    int vertex_count() const { return static_cast<int>(positions.rows()); }
    int face_count() const { return static_cast<int>(face_begin.size()) - 1; }
    int corner_count(int face) const { return face_begin[face + 1] - face_begin[face]; }
    int group_index(const std::string& name) const {  ///< -1 when there is none
        for (std::size_t i = 0; i < group_names.size(); ++i)
            if (group_names[i] == name) return static_cast<int>(i);
        return -1;
    }
};

/// Fan triangles of the faces whose group is listed (all faces when `groups` is empty), in face order.
/// A quad is cut along its shorter diagonal in the mesh's own positions. `corners`, when given, receives F x 3 corner
/// indices (for texture coordinates).
Triangles triangulate(const PolygonMesh& mesh, const std::vector<int>& groups = {},
                      Triangles* corners = nullptr);

}  // namespace risorius::geom
