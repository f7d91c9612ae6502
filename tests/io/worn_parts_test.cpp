// SPDX-License-Identifier: MIT
// What a head wears, such as hair, is in the file, but no part of the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "risorius/io/gltf_shapes.h"
#include "risorius/io/morph_model.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

/// A quad and a card that is worn on it, which a shape moves together.
MorphModel quad_with_a_card() {
    MorphModel model;
    model.name = "quad";
    model.nodes = {{.name = "quad"}, {.name = "worn"}};
    model.vertices.resize(7, 3);
    model.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1;
    model.worn_normals.resize(3, 3);
    model.worn_normals << 0.6, 0, 0.8, 0, 0.6, 0.8, 0, 0, 1;
    MorphPart skin;
    skin.name = "skin";
    skin.triangles.resize(2, 3);
    skin.triangles << 0, 1, 2, 0, 2, 3;
    MorphPart card;
    card.name = "card";
    card.node = 1;
    card.triangles.resize(1, 3);
    card.triangles << 4, 5, 6;
    card.texcoords.resize(3, 2);
    card.texcoords << 0, 0, 1, 0, 1, 1;
    card.tint = Points::Constant(7, 3, 0.5);
    card.picture = 0;
    card.picture_cuts = card.see_both_sides = true;
    card.cut_at = 0.25;
    model.parts = {skin, card};
    model.pictures = {{"strands", "image/png", "bytes of a picture"}};
    Points push(2, 3), lift(1, 3);
    push << 0.125, 0, 0, 0.125, 0, 0;
    lift << 0, 0, 0.25;
    model.targets = {{"lift", {0}, lift}, {"push", {1, 5}, push}};
    model.extras = {{"risorius", {{"set", "arkit52"}}}};
    return model;
}

Json json_of_glb(const std::string& bytes) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return Json::parse(bytes.substr(20, length));
}

TEST(WornParts, AreAMeshOfTheirOwnWithAMaskAndTheNormalsThatWereGiven) {
    for (const bool whole_numbers : {false, true}) {
        MorphModel model = quad_with_a_card();
        model.whole_numbers = whole_numbers;
        const std::string bytes = glb_bytes(model);
        EXPECT_EQ(bytes, glb_bytes(model));
        const Json json = json_of_glb(bytes);
        const Json mesh = json["meshes"][1], primitive = mesh["primitives"][0];
        EXPECT_EQ(mesh["extras"]["targetNames"], Json(Json::array_t{"push"}));
        EXPECT_FALSE(primitive["attributes"].contains("_VERTEX"));
        EXPECT_TRUE(json["meshes"][0]["primitives"][0]["attributes"].contains("_VERTEX"));
        EXPECT_FALSE(primitive["targets"][0].contains("NORMAL"));
        const Json material = json["materials"][primitive["material"].get<std::size_t>()];
        EXPECT_EQ(material["alphaMode"], "MASK");
        EXPECT_EQ(material["alphaCutoff"], 0.25);
        EXPECT_EQ(material["doubleSided"], true);
        if (whole_numbers) continue;
        const Json accessor =
            json["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()];
        const Json view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, sizeof length);
        float first[3];
        std::memcpy(first,
                    bytes.data() + 20 + length + 8 + view.value("byteOffset", std::size_t{0}),
                    sizeof first);
        EXPECT_FLOAT_EQ(first[0], 0.6F);
        EXPECT_FLOAT_EQ(first[2], 0.8F);
    }
}

TEST(WornParts, AreNotReadBackAsPartsOfTheMesh) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "worn.glb";
    std::ofstream(file, std::ios::binary) << glb_bytes(quad_with_a_card());
    const MorphModel read = read_glb(file);
    EXPECT_EQ(read.parts.size(), 1u);
    EXPECT_EQ(read.vertices.rows(), 4);
    EXPECT_EQ(read.targets[1].vertex, std::vector<int>{1});
    const GltfShapes shapes = read_gltf_shapes(file);
    ASSERT_EQ(shapes.vertex.size(), 4u);
    EXPECT_EQ(*std::max_element(shapes.vertex.begin(), shapes.vertex.end()), 3);
    EXPECT_EQ(shapes.positions.rows(), 4);
}

}  // namespace
}  // namespace risorius::io
