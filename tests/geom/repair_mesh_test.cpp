// SPDX-License-Identifier: MIT
// What repair_mesh() and part_sheets() do to small surfaces.
#include "risorius/geom/repair_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/geom/mesh_checks.h"
#include "risorius/geom/mesh_groups.h"
#include "risorius/geom/part_sheets.h"

namespace risorius::geom {
namespace {

/// A cube of quads with an edge of 0.2 m, facing outwards, at (x, 0, 0).
void add_cube(PolygonMesh& mesh, double x) {
    const int first = mesh.vertex_count();
    mesh.positions.conservativeResize(first + 8, 3);
    for (int v = 0; v < 8; ++v)
        mesh.positions.row(first + v) << x + 0.2 * (v & 1), 0.2 * (v >> 1 & 1), 0.2 * (v >> 2);
    for (const auto& face : std::vector<std::vector<int>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        for (const int v : face) mesh.corner_vertex.push_back(first + v);
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(0);
    }
    mesh.group_names = {"skin"};
}

PolygonMesh cube() {
    PolygonMesh mesh;
    add_cube(mesh, 0);
    return mesh;
}

void add_face(PolygonMesh& mesh, const std::vector<int>& vertices) {
    mesh.corner_vertex.insert(mesh.corner_vertex.end(), vertices.begin(), vertices.end());
    mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
    mesh.face_group.push_back(0);
}

using Lines = std::vector<std::string>;

TEST(RepairMesh, LeavesASoundMeshAsItIs) {
    PolygonMesh mesh = cube();
    EXPECT_EQ(repair_mesh(mesh), Lines{});
    EXPECT_EQ(mesh.corner_vertex, cube().corner_vertex);
}

TEST(RepairMesh, TakesOutWhatHasNoAreaOrIsThereTwice) {
    PolygonMesh mesh = cube();
    add_face(mesh, {0, 2, 2});
    add_face(mesh, {3, 1, 0, 2});
    EXPECT_EQ(
        repair_mesh(mesh),
        (Lines{"one face was taken out: it had less than three corners, a vertex twice or no area",
               "one face was taken out: it had the vertices of another one"}));
    EXPECT_EQ(mesh.corner_vertex, cube().corner_vertex);
    check_mesh(mesh, "cube");
}

TEST(RepairMesh, ListsAVertexOnce) {
    PolygonMesh mesh = cube();
    // The quad 0 2 3 1, with vertex 3 twice
    mesh.corner_vertex.insert(mesh.corner_vertex.begin() + 2, 3);
    for (std::size_t f = 1; f < mesh.face_begin.size(); ++f) ++mesh.face_begin[f];
    EXPECT_EQ(repair_mesh(mesh), Lines{"one face was freed of a vertex that followed itself"});
    EXPECT_EQ(mesh.corner_vertex, cube().corner_vertex);
    EXPECT_EQ(mesh.face_begin, cube().face_begin);
}

TEST(RepairMesh, TurnsFacesAsTheirNeighboursAndOutwards) {
    PolygonMesh mesh = cube();
    std::reverse(mesh.corner_vertex.begin() + 4, mesh.corner_vertex.begin() + 8);
    EXPECT_EQ(repair_mesh(mesh),
              Lines{"one face was turned to face as its neighbours do, or outwards"});
    check_mesh(mesh, "cube");
    std::reverse(mesh.corner_vertex.begin(), mesh.corner_vertex.end());
    EXPECT_EQ(repair_mesh(mesh),
              Lines{"6 faces were turned to face as its neighbours do, or outwards"});
    check_mesh(mesh, "cube");
}

TEST(RepairMesh, TakesOutFinsAndLooseBits) {
    PolygonMesh mesh = cube();
    mesh.positions.conservativeResize(12, 3);
    mesh.positions.bottomRows(4) << 0.5, 0, 0, 0.6, 0, 0, 0.6, 0.1, 0, 0.1, -1, 0;
    add_face(mesh, {0, 1, 11});  // a fin at an edge of the cube
    add_face(mesh, {8, 9, 10});  // loose
    EXPECT_EQ(repair_mesh(mesh, {.groups = {}, .loose_bit = 0.5}),
              (Lines{"one face was taken out: it met an edge where two others meet",
                     "one face was taken out: it lay loose beside the surface"}));
    check_mesh(mesh, "cube");
    EXPECT_EQ(mesh.face_count(), 6);
}

TEST(PartSheets, TwoCubesAtAnEdgeAreTwo) {
    // The second cube touches the first one at an edge, where four faces meet.
    PolygonMesh mesh = cube();
    add_cube(mesh, 0.2);
    for (long v = 8; v < 16; ++v) mesh.positions(v, 1) += 0.2;
    const std::vector<int> apart = mesh.corner_vertex;
    // Vertices 8 and 12 of the second are 3 and 7 of the first.
    for (int& v : mesh.corner_vertex) v = v == 8 ? 3 : v == 12 ? 7 : v;
    EXPECT_THROW(check_mesh(mesh, "cubes"), Error);
    EXPECT_EQ(part_sheets(mesh), 2);
    check_mesh(mesh, "cubes");
    for (std::size_t c = 0; c < 24; ++c) EXPECT_EQ(mesh.corner_vertex[c], apart[c]);
    EXPECT_EQ(part_sheets(mesh), 0);
}

TEST(PartSheets, CubesThatTouchWithAFaceAreTwo) {
    PolygonMesh mesh = cube();
    add_cube(mesh, 0.2);
    for (int& v : mesh.corner_vertex)
        if (v >= 8 && v % 2 == 0) v -= 7;  // 8 10 12 14 are 1 3 5 7
    EXPECT_EQ(part_sheets(mesh), 4);
    check_mesh(mesh, "cubes");
}

TEST(MeshGroups, MaterialsTellPartsApart) {
    PolygonMesh mesh = cube();
    mesh.group_names = {"Character"};
    mesh.material_names = {"skin", "eye_l"};
    mesh.face_material = {0, 0, 1, 1, -1, 0};
    PolygonMesh same = mesh;
    split_as_named(same, {"skin", "Character.lips"});
    EXPECT_EQ(same.group_names, Lines{"Character"});
    split_as_named(mesh, {"Character.eye_l"});
    EXPECT_EQ(mesh.group_names, (Lines{"Character", "Character.skin", "Character.eye_l"}));
    EXPECT_EQ(mesh.face_group, (std::vector<int>{1, 1, 2, 2, 0, 1}));
}

}  // namespace
}  // namespace risorius::geom
