// SPDX-License-Identifier: MIT
// Formats that are read with assimp, from small hand-written files and from files that assimp itself exports.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "paths.h"
#include "risorius/geom/weld.h"
#include "risorius/io/read_mesh.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kMeshes = fs::path(RISORIUS_SOURCE_DIR) / "tests" / "data" / "meshes";
const fs::path kMakeHuman = fs::path(RISORIUS_SHARED_DIR) / "data" / "heads" / "makehuman";

/// The OBJ of a head in another format, written by assimp.
fs::path exported(const std::string& format, const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / "risorius_formats";
    fs::create_directories(folder);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((kMakeHuman / "mh_head.obj").string(), 0);
    EXPECT_NE(scene, nullptr);
    Assimp::Exporter exporter;
    EXPECT_EQ(exporter.Export(scene, format, (folder / name).string()), aiReturn_SUCCESS);
    return folder / name;
}

/// Positions in units of the fifth decimal, the last one in the file. assimp's parser has errors in the sixth.
std::set<std::array<long, 3>> rounded_positions(const geom::PolygonMesh& mesh) {
    std::set<std::array<long, 3>> out;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        out.insert({std::lround(mesh.positions(v, 0) * 1e5),
                    std::lround(mesh.positions(v, 1) * 1e5),
                    std::lround(mesh.positions(v, 2) * 1e5)});
    return out;
}

/// Maximum distance between corners with equal numbers. Faces keep their order, whatever vertices they share.
double corner_distance(const geom::PolygonMesh& a, const geom::PolygonMesh& b) {
    double max = 0;
    for (std::size_t c = 0; c < a.corner_vertex.size(); ++c)
        max = std::max(
            max,
            (a.positions.row(a.corner_vertex[c]) - b.positions.row(b.corner_vertex[c])).norm());
    return max;
}

TEST(MeshFormats, PlyKeepsVertexOrderAndQuads) {
    const geom::PolygonMesh mesh = read_mesh(kMeshes / "polygons.ply");
    ASSERT_EQ(mesh.vertex_count(), 7);
    EXPECT_EQ(mesh.positions(6, 0), 0.375);
    EXPECT_EQ(mesh.face_begin, (std::vector<int>{0, 4, 7, 11}));
    EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{0, 1, 2, 3, 2, 5, 6, 1, 4, 5, 2}));
    EXPECT_EQ(mesh.corner_texcoord.rows(), 0);
}

TEST(MeshFormats, StlTrianglesShareTheirCorners) {
    const geom::PolygonMesh mesh = read_mesh(kMeshes / "sheet.stl");
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{0, 1, 2, 2, 1, 3}));
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"sheet"}));
}

TEST(MeshFormats, GltfAppliesNodesAndNamesGroupsAfterThem) {
    const geom::PolygonMesh mesh = read_mesh(kMeshes / "two_nodes.gltf");
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"face.skin", "face.lips", "teeth"}));
    EXPECT_EQ(mesh.face_group, (std::vector<int>{0, 1, 2}));
    // Two primitives share the four vertices of one buffer; the second mesh has four of its own.
    ASSERT_EQ(mesh.vertex_count(), 8);
    const auto near = [&](int v, const Vec3& p) {
        return (mesh.positions.row(v).transpose() - p).norm() < 1e-7;
    };
    EXPECT_TRUE(near(2, Vec3(-0.2, 1.2, 0.1)));
    EXPECT_TRUE(near(6, Vec3(0.2, 0.2, 0.05)));
    // The first node mirrors, so its corners are listed backwards to face the same way.
    EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{2, 1, 0, 3, 2, 0, 4, 5, 6}));
    // v points up, unlike in the file.
    EXPECT_EQ(mesh.corner_texcoord(0, 0), 1.0);
    EXPECT_EQ(mesh.corner_texcoord(0, 1), 0.0);
    EXPECT_EQ(mesh.corner_texcoord(2, 1), 1.0);
}

TEST(MeshFormats, ColladaAppliesItsUnit) {
    const geom::PolygonMesh mesh = read_mesh(kMeshes / "centimetres.dae");
    ASSERT_EQ(mesh.vertex_count(), 6);
    EXPECT_EQ(mesh.face_begin, (std::vector<int>{0, 4, 8}));
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"face"}));
    EXPECT_LT((mesh.positions.row(2).transpose() - Vec3(0.2, 1.2, 0)).norm(), 1e-7);
}

TEST(MeshFormats, TheGlbOfAHeadHasTheGroupsAndPositionsOfItsObj) {
    if (!fs::exists(kMakeHuman))
        GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const geom::PolygonMesh obj = read_mesh(kMakeHuman / "mh_head.obj");
    const geom::PolygonMesh glb = read_mesh(kMakeHuman / "mh_head.glb");
    EXPECT_EQ(glb.group_names, obj.group_names);
    // 5,906 quads as triangles, and 234 additional vertices at texture seams.
    EXPECT_EQ(glb.face_count(), 2 * obj.face_count());
    EXPECT_EQ(glb.vertex_count(), 6316);
    EXPECT_EQ(rounded_positions(glb), rounded_positions(obj));
    const Triangles skin = geom::triangulate(glb, {glb.group_index("skin")});
    const Triangles skin_of_obj = geom::triangulate(obj, {obj.group_index("skin")});
    EXPECT_EQ(geom::weld(glb.positions, skin).positions.rows(),
              geom::weld(obj.positions, skin_of_obj).positions.rows());
}

TEST(MeshFormats, AHeadComesThroughColladaWithGroupsAndQuads) {
    if (!fs::exists(kMakeHuman))
        GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const geom::PolygonMesh obj = read_mesh(kMakeHuman / "mh_head.obj");
    const geom::PolygonMesh dae = read_mesh(exported("collada", "head.dae"));
    EXPECT_EQ(dae.group_names, obj.group_names);
    EXPECT_EQ(dae.face_begin, obj.face_begin);
    EXPECT_EQ(dae.face_group, obj.face_group);
    EXPECT_EQ(dae.vertex_count(), obj.vertex_count());
    EXPECT_LT(corner_distance(dae, obj), 1e-5);  // single precision, in centimetres
}

TEST(MeshFormats, AHeadComesThroughFbxInMetres) {
    if (!fs::exists(kMakeHuman))
        GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    // The exporter states UnitScaleFactor 1, which means centimetres, the unit of this head.
    const geom::PolygonMesh obj = read_mesh(kMakeHuman / "mh_head.obj", {.metres_per_unit = 0.01});
    const geom::PolygonMesh fbx = read_mesh(exported("fbxa", "head.fbx"));
    EXPECT_EQ(fbx.group_names, obj.group_names);
    EXPECT_EQ(fbx.face_begin, obj.face_begin);
    EXPECT_EQ(fbx.face_group, obj.face_group);
    EXPECT_EQ(fbx.vertex_count(), obj.vertex_count());
    EXPECT_LT(corner_distance(fbx, obj), 1e-7);
}

TEST(MeshFormats, AHeadComesThroughBinaryPlyAndStl) {
    if (!fs::exists(kMakeHuman))
        GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const geom::PolygonMesh obj = read_mesh(kMakeHuman / "mh_head.obj");
    const geom::PolygonMesh ply = read_mesh(exported("plyb", "head.ply"));
    EXPECT_EQ(ply.face_begin, obj.face_begin);
    EXPECT_LT(corner_distance(ply, obj), 1e-5);
    const geom::PolygonMesh stl = read_mesh(exported("stlb", "head.stl"));
    EXPECT_EQ(stl.face_count(), 2 * obj.face_count());
    EXPECT_EQ(stl.vertex_count(), obj.vertex_count());
}

}  // namespace
}  // namespace risorius::io
