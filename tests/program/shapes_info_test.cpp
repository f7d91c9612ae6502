// SPDX-License-Identifier: MIT
// What `risorius info` says about the blend shapes of a file.
#include "tools/risorius/shapes_info.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/core/output_set.h"
#include "risorius/io/morph_model.h"
#include "temporary_folder.h"

namespace risorius::cli {
namespace {

TEST(ShapesInfo, ListsTheShapesWithTheirLargestDisplacements) {
    io::MorphModel model;
    model.name = "triangle";
    model.vertices = Points::Zero(3, 3);
    model.vertices(1, 0) = model.vertices(2, 1) = 0.1;
    io::MorphPart part;
    part.name = "Skin";
    part.triangles.resize(1, 3);
    part.triangles << 0, 1, 2;
    model.parts = {part};
    io::MorphTarget smile;
    smile.name = "smile";
    smile.vertex = {1, 2};
    smile.delta.resize(2, 3);
    smile.delta << 0.001, 0, 0, 0, 0.003, 0.004;
    model.targets = {smile};
    TemporaryFolder folder;
    write_file(folder / "a.glb", io::glb_bytes(model));

    const Json info = shapes_info(folder / "a.glb");
    EXPECT_EQ(info["vertices"], 3);
    ASSERT_EQ(info["shapes"].size(), 1u);
    EXPECT_EQ(info["shapes"][0]["name"], "smile");
    EXPECT_EQ(info["shapes"][0]["vertices"], 2);
    EXPECT_NEAR(info["shapes"][0]["largest_mm"].get<double>(), 5, 1e-4);
    EXPECT_EQ(message_of([&] { shapes_info(folder / "b.glb"); }),
              (folder / "b.glb").string() + ": expected a glTF file, found no such file");
}

}  // namespace
}  // namespace risorius::cli
