// SPDX-License-Identifier: MIT
// Blend shapes of other programs find their vertices on the rig's mesh.
#include "risorius/inverse/detail/foreign_shapes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/inverse/detail/fit_target.h"
#include "risorius/io/morph_model.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

/// A head of 40 vertices in millimetres, whose y is up in the head and z in its mesh.
rig::Head bumpy_head() {
    rig::Head head;
    head.frame.metres_per_unit = 1e-3;
    head.frame.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    head.vertices.resize(40, 3);
    for (int v = 0; v < 40; ++v)
        head.vertices.row(v) << 0.01 * (v % 8), 0.012 * (v / 8), 0.002 * ((3 * v) % 7);
    return head;
}

/// The head as a file: two meshes, of which the second has a node with a scale. Its pictures are no concern.
std::string other_program(const rig::Head& head, bool numbered, bool whole_numbers) {
    io::MorphModel model;
    model.name = "head";
    model.vertices = head.vertices;
    model.whole_numbers = whole_numbers;
    for (int half = 0; half < 2; ++half) {
        io::MorphPart& part = model.parts.emplace_back();
        part.name = half == 0 ? "skin" : "lips";
        part.normals_turn = false;  // one primitive each
        part.triangles.resize(18, 3);
        for (int f = 0; f < 18; ++f)
            part.triangles.row(f) << 20 * half + f, 20 * half + f + 1, 20 * half + f + 2;
    }
    Points lift(2, 3);
    lift << 0, 0.002, 0, 0.001, 0.003, 0;
    model.targets = {{"smile", {3, 31}, lift}, {"still", {}, Points(0, 3)}};
    const std::string bytes = io::glb_bytes(model);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    Json json = Json::parse(bytes.substr(20, length));
    Json& meshes = json["meshes"];
    meshes.push_back(meshes[0]);
    meshes[0]["primitives"].erase(1);
    meshes[1]["primitives"].erase(0);
    if (!numbered)
        for (Json& mesh : meshes) mesh["primitives"][0]["attributes"].erase("_VERTEX");
    json["nodes"][0]["name"] = "skin";
    Json second = json["nodes"][0];
    second["mesh"] = 1;
    json["nodes"].push_back(second);
    // Centimetres, by a node above both
    json["nodes"].push_back({{"children", {0, 1}}, {"scale", {100, 100, 100}}});
    json["scenes"][0]["nodes"] = {2};
    json["images"] = {{{"uri", "skin.png"}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = bytes.substr(0, 20) + text + bytes.substr(20 + length);
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        std::memcpy(out.data() + at, &number, 4);
    };
    put(8, out.size());
    put(12, text.size());
    return out;
}

class ForeignShapesOfAFile : public testing::Test {
  protected:
    io::GltfShapes read(const std::string& bytes) const {
        std::ofstream(folder_ / "other.glb", std::ios::binary) << bytes;
        return io::read_gltf_shapes(folder_ / "other.glb");
    }
    TemporaryFolder folder_;
};

TEST_F(ForeignShapesOfAFile, FindTheirVerticesByNumberOrPosition) {
    const rig::Head head = bumpy_head();
    for (const bool numbered : {true, false})
        for (const bool whole_numbers : {true, false}) {
            const io::GltfShapes shapes = read(other_program(head, numbered, whole_numbers));
            EXPECT_FALSE(shapes.by_risorius);
            ASSERT_EQ(shapes.targets.size(), 2u);
            const ForeignShapes placed = place_foreign_shapes(shapes, head, "other.glb");
            EXPECT_EQ(placed.how,
                      numbered ? "by _VERTEX: 40 of 40 vertices" : "by order: 40 of 40 vertices");
            Points expected = Points::Zero(40, 3);
            expected.row(3) << 0, 0.002, 0;
            expected.row(31) << 0.001, 0.003, 0;
            // Whole numbers of 16 bits go up to the largest coordinate of the head.
            const double half_step = head.vertices.cwiseAbs().maxCoeff() / 32767 / 2;
            EXPECT_LT((placed.fields[0] - expected).cwiseAbs().maxCoeff(),
                      whole_numbers ? 1.01 * half_step : 2e-7);
            EXPECT_TRUE(placed.fields[1].isZero(0.0));
        }
    // Another order, and a vertex less: by position
    io::GltfShapes shapes = read(other_program(head, false, false));
    shapes.positions = Points(shapes.positions.colwise().reverse()).topRows(39);
    for (int& v : shapes.targets[0].vertex) v = 39 - v;
    const ForeignShapes placed = place_foreign_shapes(shapes, head, "other.glb");
    EXPECT_EQ(placed.how, "by position: 39 of 40 vertices");
    EXPECT_FALSE(placed.known[0]);
    EXPECT_NEAR(placed.fields[0](31, 1), 0.003, 1e-7);
}

TEST_F(ForeignShapesOfAFile, OfTheFrameOfTheMeshAreTurned) {
    const rig::Head head = bumpy_head();
    io::GltfShapes shapes;
    const Mat3 back = head.frame.rotation.transpose();
    const Vec3 shift = head.frame.to_head(Vec3(Vec3::Zero()));
    shapes.positions.resize(40, 3);
    for (long v = 0; v < 40; ++v)
        shapes.positions.row(v) =
            (1e3 * back * (head.vertices.row(v).transpose() - shift)).transpose();
    Points up(1, 3);
    up.row(0) = (1e3 * back * Vec3(0, 0.004, 0)).transpose();
    shapes.targets = {{"raise", {7}, up}};
    const ForeignShapes placed = place_foreign_shapes(shapes, head, "other.glb");
    EXPECT_NEAR(placed.fields[0](7, 1), 0.004, 1e-9);
    EXPECT_NEAR(placed.fields[0].norm(), 0.004, 1e-9);
}

TEST_F(ForeignShapesOfAFile, OfAnotherMeshAreRefused) {
    io::GltfShapes shapes = read(other_program(bumpy_head(), false, false));
    shapes.positions *= 1.3;
    EXPECT_EQ(message_of([&] { place_foreign_shapes(shapes, bumpy_head(), "other.glb"); }),
              "other.glb: expected the 40 vertices of the rig's mesh at rest, by _VERTEX, order or "
              "position, found 1 of them among 40");
}

}  // namespace
}  // namespace risorius::inverse
