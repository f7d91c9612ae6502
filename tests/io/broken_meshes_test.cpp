// SPDX-License-Identifier: MIT
// Every file in tests/data/broken/meshes must fail with the words in expected.json.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/geom/mesh_checks.h"
#include "risorius/io/read_mesh.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kFolder = fs::path(RISORIUS_SOURCE_DIR) / "tests" / "data" / "broken" / "meshes";

/// Messages begin with the path as given, so files are named relative to their folder.
class BrokenMeshes : public testing::Test {
  protected:
    void SetUp() override {
        before_ = fs::current_path();
        fs::current_path(kFolder);
    }
    void TearDown() override { fs::current_path(before_); }

  private:
    fs::path before_;
};

std::string complaint(const std::string& file) {
    try {
        geom::check_mesh(read_mesh(file), file);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing";
}

TEST_F(BrokenMeshes, EachOneSaysWhatIsWrongAndWhere) {
    std::ifstream in("expected.json");
    const auto expected = nlohmann::json::parse(in);
    for (const auto& [file, message] : expected.items())
        EXPECT_EQ(complaint(file), message.get<std::string>());
}

TEST_F(BrokenMeshes, NoneIsWithoutAnExpectation) {
    std::ifstream in("expected.json");
    const auto expected = nlohmann::json::parse(in);
    int files = 0;
    for (const auto& entry : fs::directory_iterator(".")) {
        const std::string name = entry.path().filename().string();
        if (name == "expected.json") continue;
        EXPECT_TRUE(expected.contains(name)) << name;
        ++files;
    }
    EXPECT_GE(files, 8);
    EXPECT_EQ(files, static_cast<int>(expected.size()));
}

TEST_F(BrokenMeshes, AMissingFileAndAFolderAreNamed) {
    EXPECT_EQ(complaint("nobody.obj"), "nobody.obj: expected a mesh file, found no such file");
    EXPECT_EQ(complaint("."), ".: expected a mesh file, found a folder");
}

TEST_F(BrokenMeshes, AUnitMustBePositive) {
    try {
        read_mesh("millimetres.obj", {.metres_per_unit = -0.01});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "millimetres.obj: expected metres_per_unit in (0, inf), found -0.01");
    }
}

TEST_F(BrokenMeshes, TheUnitAdvisedMendsTheScale) {
    const auto mesh = read_mesh("millimetres.obj", {.metres_per_unit = 0.001});
    EXPECT_NO_THROW(geom::check_mesh(mesh, "millimetres.obj", {.metres_per_unit = 0.001}));
}

}  // namespace
}  // namespace risorius::io
