// SPDX-License-Identifier: MIT
// Meshes that are read by another process, and what that process may say.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/io/mesh_message.h"
#include "risorius/io/read_mesh.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kMadeToBreak = fs::path(RISORIUS_SOURCE_DIR) / "tests/inputs/hostile";
const fs::path kSmallMeshes = fs::path(RISORIUS_SOURCE_DIR) / "tests/data/meshes";

geom::PolygonMesh two_faces() {
    geom::PolygonMesh mesh;
    mesh.positions = Points::Random(5, 3);
    mesh.face_begin = {0, 3, 7};
    mesh.corner_vertex = {0, 1, 2, 0, 2, 3, 4};
    mesh.corner_texcoord = TexCoords::Random(7, 2);
    mesh.face_group = {1, 0};
    mesh.group_names = {"a", "b"};
    mesh.textures.push_back({"folder/a.png", "b.dae:material \"c\"", {1, 2, 3}});
    mesh.face_texture = {-1, 0};
    mesh.from_file(0, 3) = 2;
    mesh.in_file_order = false;
    mesh.notes = {"a note"};
    return mesh;
}

std::string message_with(const geom::PolygonMesh& mesh) {
    std::string bytes;
    write_mesh_message(mesh, [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    });
    return bytes;
}

std::optional<geom::PolygonMesh> read_message(const std::string& bytes) {
    std::size_t at = 0;
    MeshProblem problem;
    return read_mesh_message(
        [&](void* data, std::size_t size) {
            if (size > bytes.size() - at) return false;
            if (size > 0) std::memcpy(data, bytes.data() + at, size);
            at += size;
            return true;
        },
        problem);
}

TEST(MeshMessage, HandsOverAMesh) {
    const geom::PolygonMesh mesh = two_faces();
    const auto back = read_message(message_with(mesh));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->positions, mesh.positions);
    EXPECT_EQ(back->face_begin, mesh.face_begin);
    EXPECT_EQ(back->corner_vertex, mesh.corner_vertex);
    EXPECT_EQ(back->corner_texcoord, mesh.corner_texcoord);
    EXPECT_EQ(back->face_group, mesh.face_group);
    EXPECT_EQ(back->group_names, mesh.group_names);
    EXPECT_EQ(back->textures.at(0).file, mesh.textures[0].file);
    EXPECT_EQ(back->textures.at(0).embedded, mesh.textures[0].embedded);
    EXPECT_EQ(back->face_texture, mesh.face_texture);
    EXPECT_EQ(back->from_file, mesh.from_file);
    EXPECT_EQ(back->in_file_order, false);
    EXPECT_EQ(back->notes, mesh.notes);
}

// A process that was taken over by its input can say anything. What is accepted is a mesh all the same.
TEST(MeshMessage, ThatIsNotSoundIsNoMesh) {
    const std::string good = message_with(two_faces());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(read_message(good.substr(0, size))) << size;
    for (std::size_t at = 0; at < good.size(); ++at)
        for (const int change : {0x01, 0x40, 0x80, 0xff}) {
            std::string bytes = good;
            bytes[at] = static_cast<char>(bytes[at] ^ change);
            const auto mesh = read_message(bytes);
            if (!mesh) continue;
            ASSERT_EQ(mesh->face_begin.back(), static_cast<int>(mesh->corner_vertex.size()));
            ASSERT_EQ(mesh->face_group.size(), static_cast<std::size_t>(mesh->face_count()));
            for (const int v : mesh->corner_vertex) ASSERT_TRUE(v >= 0 && v < mesh->vertex_count());
            for (const int g : mesh->face_group)
                ASSERT_TRUE(g >= 0 && g < static_cast<int>(mesh->group_names.size()));
            for (const int t : mesh->face_texture)
                ASSERT_TRUE(t >= -1 && t < static_cast<int>(mesh->textures.size()));
        }
}

TEST(ImportProcess, SaysWhyItHasNoMesh) {
    const auto message = [](const char* name) {
        return message_of([&] { read_mesh(kMadeToBreak / name); });
    };
    EXPECT_EQ(
        message("hang.ply"),
        (kMadeToBreak / "hang.ply").string() +
            ": expected a mesh, found one that the mesh importer could not read: it took more "
            "than 3 s");
#ifndef __SANITIZE_ADDRESS__
    EXPECT_EQ(
        message("oom.dae"),
        (kMadeToBreak / "oom.dae").string() +
            ": expected a mesh, found one that the mesh importer could not read: it took more "
            "than 480 MB of memory");
#endif
}

TEST(ImportProcess, ACrashIsAnErrorThatSaysSo) {
    const TemporaryFolder folder;
    std::ofstream file(folder / "deep.fbx");
    file << "; FBX 7.3.0 project file\n";
    for (int i = 0; i < 200000; ++i) file << "A: {";
    file.close();
    EXPECT_NE(message_of([&] { read_mesh(folder / "deep.fbx"); }).find("could not read: it "),
              std::string::npos);
}

TEST(ImportProcess, StripsInPlyAreRefused) {
    const TemporaryFolder folder;
    std::ofstream(folder / "strips.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
           "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n";
    EXPECT_EQ(message_of([&] { read_mesh(folder / "strips.ply"); }),
              (folder / "strips.ply").string() +
                  ": expected faces (export the mesh as triangles), found strips of triangles");
}

TEST(ImportProcess, ThatIsNotInstalledIsNamed) {
    ::setenv("RISORIUS_IMPORT_MESH", "/nowhere/at/all", 1);
    const std::string said = message_of([] { read_mesh(kSmallMeshes / "sheet.stl"); });
    ::unsetenv("RISORIUS_IMPORT_MESH");
    EXPECT_EQ(said, "RISORIUS_IMPORT_MESH: expected a program, found \"/nowhere/at/all\"");
}

TEST(ImportProcess, EndsWhenTheCallerAsks) {
    int asked = 0;
    EXPECT_THROW(read_mesh(kMadeToBreak / "hang.ply",
                           {.metres_per_unit = 1, .stopped = [&] { return ++asked > 2; }}),
                 Interrupted);
}

TEST(ImportProcess, WorksWhereChildrenAreNotWaitedFor) {
    const auto before = std::signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(read_mesh(kSmallMeshes / "sheet.stl").vertex_count(), 4);
    std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace risorius::io
