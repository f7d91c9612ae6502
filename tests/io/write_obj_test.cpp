// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/io/read_mesh.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;

fs::path scratch(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / "risorius_write_obj";
    fs::create_directories(folder);
    return folder / name;
}

void expect_same(const geom::PolygonMesh& a, const geom::PolygonMesh& b) {
    EXPECT_TRUE(a.positions == b.positions);
    EXPECT_EQ(a.face_begin, b.face_begin);
    EXPECT_EQ(a.corner_vertex, b.corner_vertex);
    EXPECT_TRUE(a.corner_texcoord == b.corner_texcoord);
    EXPECT_EQ(a.face_group, b.face_group);
    EXPECT_EQ(a.group_names, b.group_names);
}

/// A triangle, a quad and a pentagon in two groups that alternate, with coordinates that no short decimal can represent.
geom::PolygonMesh mixed_polygons() {
    geom::PolygonMesh mesh;
    mesh.positions.resize(8, 3);
    for (int v = 0; v < 8; ++v) mesh.positions.row(v) << 1.0 / (v + 3), v * 0.1, -1e-7 * v / 7.0;
    mesh.face_begin = {0, 3, 7, 12};
    mesh.corner_vertex = {7, 1, 2, 0, 1, 3, 4, 2, 3, 4, 5, 6};
    mesh.corner_texcoord.resize(12, 2);
    for (int c = 0; c < 12; ++c) mesh.corner_texcoord.row(c) << (c % 5) / 3.0, c / 11.0;
    mesh.face_group = {0, 1, 0};
    mesh.group_names = {"skin of the face", "teeth"};
    return mesh;
}

TEST(WriteObj, ComesBackBitForBit) {
    const fs::path file = scratch("mixed.obj");
    const geom::PolygonMesh mesh = mixed_polygons();
    write_obj(mesh, file);
    expect_same(read_mesh(file), mesh);
}

TEST(WriteObj, WritesTheUnitAskedFor) {
    const fs::path file = scratch("unit.obj");
    const geom::PolygonMesh mesh = mixed_polygons();
    write_obj(mesh, file, 0.01);
    EXPECT_NEAR(read_mesh(file).positions(0, 0), 100.0 / 3.0, 1e-13);
    // Dividing and multiplying by 0.01 round once each: a few parts in 1e16.
    const geom::PolygonMesh back = read_mesh(file, {.metres_per_unit = 0.01});
    for (int v = 0; v < 8; ++v)
        EXPECT_LT((back.positions.row(v) - mesh.positions.row(v)).norm(), 1e-15);
}

TEST(WriteObj, KeepsARealHeadThroughARoundTrip) {
    const fs::path head =
        fs::path(RISORIUS_SHARED_DIR) / "data" / "heads" / "makehuman" / "mh_head.obj";
    if (!fs::exists(head)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const geom::PolygonMesh mesh = read_mesh(head);
    write_obj(mesh, scratch("head.obj"));
    expect_same(read_mesh(scratch("head.obj")), mesh);
}

TEST(WriteObj, LeavesNothingHalfWritten) {
    const fs::path file = scratch("whole.obj");
    write_obj(mixed_polygons(), file);
    EXPECT_THROW(write_obj(mixed_polygons(), file / "deep" / "a.obj"), Error);
    for (const auto& entry : fs::directory_iterator(file.parent_path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".risorius-"));
}

}  // namespace
}  // namespace risorius::io
