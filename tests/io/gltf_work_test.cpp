// SPDX-License-Identifier: MIT
// The work on a glTF file grows with its size, also where nodes lie in one another, or use one mesh again and again.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "message_of.h"
#include "risorius/io/animation_tracks.h"
#include "risorius/io/gltf_shapes.h"
#include "risorius/io/read_mesh.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

std::string repeated(const std::string& item, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += (i > 0 ? "," : "") + item;
    return out;
}

/// A triangle with one blend shape in a file: its nodes, the parts of its mesh, the names of targets, and more of the root.
class GltfWork : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& nodes, const std::string& primitives = kPart,
                               const std::string& names = "\"open\"",
                               const std::string& more = "") const {
        std::ofstream(folder_ / "a.gltf")
            << R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri":
            "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 0, "componentType": 5126, "count": 1, "type": "SCALAR"}],
            "meshes": [{"primitives": [)"
            << primitives << R"(], "extras": {"targetNames": [)" << names << R"(]}}], "nodes": [)"
            << nodes << "]" << more << "}";
        return folder_ / "a.gltf";
    }
    static constexpr const char* kPart =
        R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]})";

  private:
    TemporaryFolder folder_;
};

TEST_F(GltfWork, NodesMayLieDeepInOneAnother) {
    constexpr int kNodes = 300000;
    std::string nodes = R"({"translation": [1, 0, 0], "children": [1]})";
    for (int n = 2; n < kNodes; ++n) nodes += ",{\"children\":[" + std::to_string(n) + "]}";
    const GltfShapes shapes = read_gltf_shapes(file(nodes + R"(,{"mesh": 0, "scale": [2, 2, 2]})"));
    EXPECT_EQ(shapes.positions.row(1), Eigen::RowVector3d(3, 0, 0));
}

TEST_F(GltfWork, NodesInACircleAreRefused) {
    const std::string circle = R"({"children": [1]},{"children": [0], "mesh": 0})";
    EXPECT_NE(message_of([&] { read_gltf_shapes(file(circle)); }).find("not inside of itself"),
              std::string::npos);
}

TEST_F(GltfWork, OneMeshIsNotUsedWithoutEnd) {
    const std::string out_of_proportion = "expected no more numbers than a file of its size holds";
    const std::string nodes = repeated("{\"mesh\":0}", 20000),
                      parts = repeated("{\"attributes\":{}}", 20000),
                      names = repeated("\"n\"", 20000);
    EXPECT_NE(message_of([&] { read_mesh(file(nodes, parts)); }).find(out_of_proportion),
              std::string::npos);
    EXPECT_NE(message_of([&] { read_gltf_shapes(file(nodes, parts)); }).find(out_of_proportion),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  read_gltf_shapes(file(nodes, "{\"attributes\":{}}", names));
              }).find(out_of_proportion),
              std::string::npos);
    const std::string animation =
        R"(, "animations": [{"samplers": [{"input": 1, "output": 1}], "channels": [)" +
        repeated(R"({"sampler": 0, "target": {"node": 0, "path": "weights"}})", 20000) + "]}]";
    EXPECT_NE(message_of([&] {
                  read_animation_tracks(file("{\"mesh\":0}", kPart, names, animation));
              }).find(out_of_proportion),
              std::string::npos);
}

TEST_F(GltfWork, NamesOfTargetsThatAreNotThereAreLeftOut) {
    const AnimationTracks read =
        read_animation_tracks(file("{\"mesh\":0}", kPart, R"("jawOpen","mouthPucker")",
                                   R"(, "animations": [{"samplers": [{"input": 1, "output": 1}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}])"));
    ASSERT_EQ(read.tracks.size(), 1u);
    EXPECT_EQ(read.tracks[0].targets, std::vector<std::string>{"jawOpen"});
    EXPECT_EQ(read.tracks[0].values.cols(), 1);
}

}  // namespace
}  // namespace risorius::io
