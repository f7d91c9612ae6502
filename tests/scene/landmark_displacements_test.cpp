// SPDX-License-Identifier: MIT
// How far landmarks go in expressions, written and read.
#include "risorius/scene/landmark_displacements.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "temporary_folder.h"

namespace risorius::scene {
namespace {

TEST(LandmarkDisplacements, AreReadAsTheyWereWritten) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "ways.json";
    std::ofstream(file) << landmark_displacements_json(
                               {{"jawOpen", {{"li", Vec3(0, -0.01234, 0.0021)}}}}, "a test")
                               .dump();
    EXPECT_LT((read_landmark_displacements(file).at("jawOpen").at("li") - Vec3(0, -0.01234, 0.0021))
                  .norm(),
              1e-12);
}

}  // namespace
}  // namespace risorius::scene
