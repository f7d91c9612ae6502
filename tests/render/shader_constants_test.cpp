// SPDX-License-Identifier: MIT
#include "risorius/render/detail/shader_constants.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace risorius::render {
namespace {

TEST(ShaderConstants, StandInPlaceOfTheUniformsTheyAreSetFor) {
    ShaderConstants constants;
    constants.set("albedo", Vec3(0.5, 1.0, 1e-7));
    constants.set("share", 0.1);
    constants.set("closed", true);
    constants.set("missing", 2.0);
    EXPECT_EQ(constants.in("#version 450 core\n"
                           "uniform vec3 albedo;      // linear\n"
                           "uniform float share;\n"
                           "uniform bool closed;\n"
                           "uniform vec3 centre;\n"),
              "#version 450 core\n"
              "const vec3 albedo = vec3(0.5, 1.0, 1e-07);      // linear\n"
              "const float share = 0.1;\n"
              "const bool closed = true;\n"
              "uniform vec3 centre;\n");
}

TEST(ShaderConstants, MatricesAreToldColumnByColumn) {
    Mat3 turn;
    turn << 1, 2, 3, 4, 5, 6, 7, 8, 9;
    ShaderConstants constants;
    constants.set("turn", turn);
    EXPECT_EQ(constants.in("#version 450 core\nuniform mat3 turn;\n"),
              "#version 450 core\nconst mat3 turn = mat3(1.0, 4.0, 7.0, 2.0, 5.0, 8.0, 3.0, 6.0, "
              "9.0);\n");
}

TEST(ShaderConstants, ThePreludeFollowsTheVersion) {
    ShaderConstants constants;
    constants.set_prelude("#define LIGHTS_TOLD\n");
    EXPECT_EQ(constants.in("#version 450 core\nvoid main() {}\n"),
              "#version 450 core\n#define LIGHTS_TOLD\nvoid main() {}\n");
}

TEST(ShaderConstants, EveryFloatComesBackFromItsText) {
    for (const float number : {0.1F, 1.0F / 3.0F, 12345.678F, 1.17549435e-38F, -0.0F, 16777217.0F})
        EXPECT_EQ(std::stof(glsl("float", std::array{number}).substr(6)), number);
}

}  // namespace
}  // namespace risorius::render
