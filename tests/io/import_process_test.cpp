// SPDX-License-Identifier: MIT
// Meshes that are read by another process, and what that process may say.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
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
    const auto took_more = [](const char* name, const char* limit) {
        return (kMadeToBreak / name).string() +
               ": expected a mesh, found one that the mesh importer could not read: it took more "
               "than " +
               limit;
    };
    EXPECT_EQ(message("hang.ply"), took_more("hang.ply", "3 s"));
#ifndef __SANITIZE_ADDRESS__
    // A busy machine takes 3 s of processor time for pages before they are 480 MB.
    const std::string found = message("oom.dae");
    EXPECT_TRUE(found == took_more("oom.dae", "480 MB of memory") ||
                found == took_more("oom.dae", "3 s"))
        << found;
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

/// The bytes of numbers in the order of this machine, or the other one.
template <typename Value>
std::string packed(std::initializer_list<Value> values, bool turned) {
    std::string out;
    for (const Value value : values) {
        std::string bytes(sizeof value, '\0');
        std::memcpy(bytes.data(), &value, sizeof value);
        if (turned) std::reverse(bytes.begin(), bytes.end());
        out += bytes;
    }
    return out;
}

TEST(ImportProcess, StripsInPlyAreTriangles) {
    const TemporaryFolder folder;
    const auto header = [](const std::string& format) {
        return "ply\nformat " + format +
               " 1.0\nelement vertex 6\nproperty float x\nproperty uchar red\n"
               "property float y\nproperty float z\nproperty float s\nproperty float t\n"
               "element face 1\nproperty list uchar int vertex_indices\n"
               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    };
    std::string text = header("ascii"), numbers[2];
    for (int v = 0; v < 6; ++v)
        text += std::to_string(v % 2) + " 255 +" + std::to_string(v / 2) + " 0.5 0.25 " +
                std::to_string(v) + "\n";
    // A triangle, a strip of three, and after its end one of a single triangle
    text += "3 0 1 2\n9 0 1 2 3 4 -1 2 3 5\n";
    std::ofstream(folder / "text.ply") << text;
    for (const bool turned : {false, true}) {
        std::string& bytes = numbers[turned ? 1 : 0];
        for (int v = 0; v < 6; ++v)
            bytes +=
                packed({static_cast<float>(v % 2)}, turned) + '\xff' +
                packed({static_cast<float>(v / 2), 0.5F, 0.25F, static_cast<float>(v)}, turned);
        bytes +=
            '\x03' + packed({0, 1, 2}, turned) + packed({9, 0, 1, 2, 3, 4, -1, 2, 3, 5}, turned);
    }
    const std::string little = header("binary_little_endian") + numbers[0];
    std::ofstream(folder / "little.ply") << little;
    std::ofstream(folder / "big.ply") << header("binary_big_endian") + numbers[1];
    for (const char* name : {"text.ply", "little.ply", "big.ply"}) {
        SCOPED_TRACE(name);
        const geom::PolygonMesh mesh = read_mesh(folder / name);
        ASSERT_EQ(mesh.vertex_count(), 6);
        EXPECT_EQ(Vec3(mesh.positions.row(3).transpose()), Vec3(1, 1, 0.5));
        EXPECT_EQ(mesh.corner_vertex,
                  (std::vector<int>{0, 1, 2, 0, 1, 2, 2, 1, 3, 2, 3, 4, 2, 3, 5}));
        ASSERT_EQ(mesh.corner_texcoord.rows(), 15);
        EXPECT_EQ(Vec2(mesh.corner_texcoord.row(8).transpose()), Vec2(0.25, 3));
        EXPECT_TRUE(mesh.in_file_order);
    }
    const auto message = [&](const std::string& bytes) {
        std::ofstream(folder / "wrong.ply") << bytes;
        const std::string said = message_of([&] { read_mesh(folder / "wrong.ply"); });
        return said.substr(std::min(said.size(), (folder / "wrong.ply").string().size()));
    };
    for (std::size_t size = little.find("tristrips 1") + 12; size < little.size(); ++size)
        EXPECT_TRUE(message(little.substr(0, size)).starts_with(": expected ")) << size;
    std::string wrong = text;
    wrong.replace(wrong.rfind("-1 2"), 4, "-1 7");
    EXPECT_EQ(message(wrong), ": expected vertices in 0 .. 5, found 7");
    wrong = text;
    wrong.replace(wrong.find("vertex 6"), 8, "vertex 9999999999");
    EXPECT_TRUE(message(wrong).starts_with(": expected ")) << message(wrong);
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
