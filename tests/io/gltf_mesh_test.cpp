// SPDX-License-Identifier: MIT
// glTF files as users bring them, and files that are made to break readers.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/io/morph_model.h"
#include "risorius/io/read_mesh.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kInputs = fs::path(RISORIUS_SOURCE_DIR) / "tests/inputs";
const fs::path kCases = kInputs / "public_cases", kHostile = kInputs / "hostile";

/// A .gltf with a buffer beside it.
class GltfMesh : public testing::Test {
  protected:
    geom::PolygonMesh read(const std::string& json, const std::vector<float>& numbers) {
        std::ofstream(folder_ / "numbers.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(numbers.data()),
                   static_cast<std::streamsize>(4 * numbers.size()));
        std::ofstream(folder_ / "a.gltf")
            << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"numbers.bin","byteLength":)"
            << 4 * numbers.size() << R"(}],"bufferViews":[{"buffer":0,"byteLength":)"
            << 4 * numbers.size() << "}]," << json << "}";
        return read_mesh(folder_ / "a.gltf");
    }
    TemporaryFolder folder_;
};

const std::vector<float> kFour{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::string kPositions =
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],)";

std::string one_mesh(const std::string& mode) {
    return kPositions +
           R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
           mode + "}]}]";
}

TEST_F(GltfMesh, StripsAndFansAreTriangles) {
    EXPECT_EQ(read(one_mesh("5"), kFour).corner_vertex, (std::vector<int>{0, 1, 2, 2, 1, 3}));
    EXPECT_EQ(read(one_mesh("6"), kFour).corner_vertex, (std::vector<int>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(read(one_mesh("4"), kFour).corner_vertex, (std::vector<int>{0, 1, 2}));
    EXPECT_NE(message_of([&] { read(one_mesh("1"), kFour); }).find("expected faces, found none"),
              std::string::npos);
}

TEST_F(GltfMesh, TheTransformOfANodeWithASkinSaysNothing) {
    // The joint moves by 1 in x, and takes back what its inverse matrix says.
    std::vector<float> numbers = kFour;
    numbers.insert(numbers.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});   // weights
    numbers.insert(numbers.end(), {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});   // joints
    numbers.insert(numbers.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});  // its matrix
    const geom::PolygonMesh mesh = read(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC4"},
{"bufferView":0,"byteOffset":112,"componentType":5121,"count":4,"type":"VEC4"},
{"bufferView":0,"byteOffset":176,"componentType":5126,"count":1,"type":"MAT4"}],
"nodes":[{"mesh":0,"skin":0,"scale":[7,7,7]},{"translation":[1,1,0]}],
"skins":[{"joints":[1],"inverseBindMatrices":3}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"WEIGHTS_0":1,"JOINTS_0":2}}]}])",
        numbers);
    EXPECT_NEAR(mesh.positions(1, 0), 2, 1e-6);
    EXPECT_NEAR(mesh.positions(1, 1), 0, 1e-6);
}

TEST_F(GltfMesh, APictureIsLaidAsItsTransformSays) {
    std::vector<float> numbers = kFour;
    numbers.insert(numbers.end(), {0.25F, 0, 0.5F, 0, 0, 1, 1, 1});
    const geom::PolygonMesh mesh = read(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC2"}],
"nodes":[{"mesh":0}],"images":[{"uri":"a%20b.png"}],"textures":[{"source":0}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":
{"KHR_texture_transform":{"offset":[0.125,0],"scale":[2,1]}}}}}],
"meshes":[{"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}])",
        numbers);
    EXPECT_DOUBLE_EQ(mesh.corner_texcoord(0, 0), 0.625);
    EXPECT_DOUBLE_EQ(mesh.corner_texcoord(0, 1), 1);
    EXPECT_EQ(mesh.textures.at(0).file.filename(), "a b.png");
}

TEST_F(GltfMesh, WhatIsNotReadIsRefusedByName) {
    EXPECT_NE(
        message_of([&] {
            read(kPositions +
                     R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},
"extensions":{"KHR_draco_mesh_compression":{}}}]}])",
                 kFour);
        }).find("a mesh that is not packed by Draco"),
        std::string::npos);
    EXPECT_NE(message_of([] {
                  read_mesh(kCases / "gltf_requires_unknown.glb");
              }).find("found \"EXT_unheard_of_geometry\""),
              std::string::npos);
}

TEST_F(GltfMesh, WhatDoesNotFitItsBytesIsRefused) {
    const auto with = [&](const std::string& accessor) {
        return message_of([&] {
            read(
                R"("accessors":[{"componentType":5126,"type":"VEC3",)" + accessor +
                    R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])",
                kFour);
        });
    };
    EXPECT_NE(with(R"("bufferView":0,"count":5)").find("found a view of 48 bytes"),
              std::string::npos);
    EXPECT_NE(with(R"("bufferView":0,"count":1000000000)").find("at most 10 million vertices"),
              std::string::npos);
    EXPECT_NE(with(R"("bufferView":0,"byteOffset":900719925474099,"count":4)").find("view of 48"),
              std::string::npos);
    EXPECT_NE(with(R"("bufferView":0,"count":-1)").find("/accessors/0/count: expected"),
              std::string::npos);
    EXPECT_NE(with(R"("bufferView":0,"count":1.5)").find("a whole number"), std::string::npos);
    EXPECT_NE(with(R"("bufferView":7,"count":4)").find("one of the 1 bufferViews"),
              std::string::npos);
    EXPECT_NE(with(R"("count":1000000000)").find("at most 10 million vertices"), std::string::npos);
}

TEST_F(GltfMesh, NodesFormATree) {
    const std::string mesh = R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const auto with = [&](const std::string& nodes) {
        return message_of([&] { read(kPositions + "\"nodes\":" + nodes + mesh, kFour); });
    };
    // 2^30 nodes, if each were visited on each way
    EXPECT_NE(with(R"([{"children":[1,1]},{"mesh":0}])").find("a node with one parent"),
              std::string::npos);
    EXPECT_NE(with(R"([{"children":[1]},{"children":[0],"mesh":0}])").find("not inside of itself"),
              std::string::npos);
    // 100,000 nodes in one another are no reason to recurse.
    std::string deep = R"([{"mesh":0,"children":[1]})";
    for (int i = 0; i < 100000; ++i) deep += ",{\"children\":[" + std::to_string(i + 2) + "]}";
    EXPECT_EQ(with(deep + ",{}]"), "no error");
}

TEST(HostileGlb, TextAfterTheJsonIsRefused) {
    const TemporaryFolder folder;
    for (const std::string text : {"{}\"a\"", "{\"b\":{}}\"a\":1", "{\"a", "{]\"a\"", "{},\"a\""}) {
        std::ofstream(folder / "a.gltf") << text;
        EXPECT_NE(message_of([&] { read_mesh(folder / "a.gltf"); }).find("expected valid JSON"),
                  std::string::npos)
            << text;
    }
}

TEST(GltfCases, AreRead) {
    const geom::PolygonMesh plain = read_mesh(kCases / "obj_plain.obj");
    for (const char* name : {"gltf_quantized.glb", "gltf_quantized_14_bits.glb", "gltf_meshopt.glb",
                             "gltf_named_vrm.vrm"}) {
        const geom::PolygonMesh mesh = read_mesh(kCases / name);
        ASSERT_EQ(mesh.vertex_count(), plain.vertex_count()) << name;
        for (int v = 0; v < mesh.vertex_count(); ++v)
            // 60 in units of millimetres; 14 bits over 0.12 m are steps of 7 micrometres.
            EXPECT_LT((mesh.positions.row(v) - 1e-3 * plain.positions.row(v)).norm(), 2e-5) << name;
        EXPECT_EQ(mesh.group_names, std::vector<std::string>{"skin"});
    }
}

TEST(HostileGlb, BlendShapesAreRefusedWithThePlace) {
    const auto message = [](const fs::path& file) { return message_of([&] { read_glb(file); }); };
    EXPECT_NE(message(kHostile / "vertex_nan2.glb").find("expected whole numbers of at least 0"),
              std::string::npos);
    EXPECT_NE(message(kHostile / "count_sparse_1e9.glb").find("expected"), std::string::npos);
    EXPECT_NE(message(kHostile / "targets_nonstring.glb").find("targetNames/0: expected a string"),
              std::string::npos);
}

TEST(HostileGlb, DeepExtrasAreRefused) {
    const TemporaryFolder folder;
    std::string json = R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') +
                       std::string(100000, ']') + "}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto length = static_cast<std::uint32_t>(json.size());
    const std::uint32_t header[] = {0x46546C67, 2, length + 20, length, 0x4E4F534A};
    std::ofstream(folder / "deep.glb", std::ios::binary)
        << std::string(reinterpret_cast<const char*>(header), sizeof header) << json;
    EXPECT_NE(message_of([&] { read_glb(folder / "deep.glb"); }).find("at most 200 arrays"),
              std::string::npos);
    EXPECT_NE(message_of([&] { read_mesh(folder / "deep.glb"); }).find("at most 200 arrays"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::io
