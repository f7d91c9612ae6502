// SPDX-License-Identifier: MIT
// Which muscles are solids, as a rig file says it.
#include "risorius/rig/detail/solid_muscles.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "paths.h"

namespace risorius::rig {
namespace {

MuscleTable table() {
    static const MuscleTable kTable = read_muscle_table(JsonCursor::read_file(
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard/muscles.json"));
    return kTable;
}

std::vector<SolidMuscle> read(const char* json) {
    return read_solid_muscles(JsonCursor::from_json(Json::parse(json), "rig.json"), table());
}

std::string message_of(const char* json) {
    try {
        read(json);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(SolidMuscles, AnEmptyEntryTakesItsSizeFromTheTableOfMuscles) {
    const std::vector<SolidMuscle> solids = read(R"({"masseter_superficial": {}})");
    ASSERT_EQ(solids.size(), 1u);
    EXPECT_DOUBLE_EQ(solids[0].width_m, 0.028);
    EXPECT_DOUBLE_EQ(solids[0].thickness_m, 0.011);
    EXPECT_EQ(solids[0].strength, 1.0);
}

TEST(SolidMuscles, WhatIsWrittenIsReadAgain) {
    const std::vector<SolidMuscle> solids = read(
        R"({"mentalis": {"strength": 0.2, "width_mm": 8, "ends": [0.5, 0.9], "cells": [4, 2, 1], "shear_pa": 900}})");
    const Json again = solid_muscles_json(solids);
    EXPECT_EQ(solid_muscles_json(read_solid_muscles(JsonCursor::from_json(again, "a"), table())),
              again);
}

std::string sample(const std::string& file) {
    return (std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples" / file).string();
}

TEST(SolidMuscles, AMeshIsReadWithItsEntryAndWrittenWithItsPath) {
    const std::string file = sample("belly/masseter.msh");
    const Json json = {{"masseter_superficial",
                        {{"shear_pa", 1930},
                         {"shear_along_pa", 5770},
                         {"stretch_along_pa", 36000},
                         {"mesh", {{"file", file}, {"along", {0, -2, 0}}, {"ends", {0.1, 0.2}}}}}}};
    const std::vector<SolidMuscle> solids =
        read_solid_muscles(JsonCursor::from_json(json, "rig.json"), table());
    ASSERT_TRUE(solids[0].mesh && solids[0].is_stiffer_along());
    EXPECT_EQ(solids[0].mesh->left->tets.rows(), 384);
    EXPECT_EQ(solids[0].mesh->left->fibres.rows(), 384);
    EXPECT_FALSE(solids[0].mesh->right);
    EXPECT_EQ(*solids[0].mesh->along, Vec3(0, -1, 0));
    const Json again = solid_muscles_json(solids);
    EXPECT_EQ(again["masseter_superficial"]["mesh"]["file"], file);
    EXPECT_EQ(solid_muscles_json(read_solid_muscles(JsonCursor::from_json(again, "a"), table())),
              again);
    const Json named =
        solid_muscles_json(solids, [](const std::filesystem::path&) { return "here.msh"; });
    EXPECT_EQ(named["masseter_superficial"]["mesh"]["file"], "here.msh");
}

TEST(SolidMuscles, WithoutNumbersAlongFibresNothingIsStifferAlongThem) {
    const std::vector<SolidMuscle> solids = read(R"({"mentalis": {"shear_pa": 900}})");
    EXPECT_FALSE(solids[0].is_stiffer_along());
    EXPECT_FALSE(solid_muscles_json(solids)["mentalis"].contains("shear_along_pa"));
}

TEST(SolidMuscles, MistakesInAMeshAreNamed) {
    const auto with = [&](const std::string& muscle, const std::string& mesh,
                          const std::string& more = "") {
        return message_of(("{\"" + muscle + "\": {" + more + "\"mesh\": {" + mesh + "}}}").c_str());
    };
    const std::string file = "\"file\": \"" + sample("belly/masseter.msh") + "\"";
    EXPECT_EQ(with("mentalis", file, R"("width_mm": 4, )"),
              "rig.json:/mentalis/width_mm: expected one of strength shear_pa shear_along_pa "
              "stretch_along_pa volume_pa source mesh, found unknown key \"width_mm\"");
    EXPECT_EQ(with("mentalis", file + R"(, "ends": [0.1])"),
              "rig.json:/mentalis/mesh/ends: expected two fractions, of the origin and the "
              "insertion, found [0.1]");
    EXPECT_EQ(with("mentalis", file + R"(, "along": [0, 0, 0])"),
              "rig.json:/mentalis/mesh/along: expected a direction, found [0,0,0]");
    EXPECT_EQ(with("mentalis", ""),
              "rig.json:/mentalis/mesh: expected the key \"file\", found none");
    EXPECT_EQ(with("orbicularis_oris_upper_peripheral", file),
              "rig.json:/orbicularis_oris_upper_peripheral/mesh: expected no mesh: both halves of "
              "the ring are one solid, found a mesh");
    EXPECT_EQ(message_of(R"({"mentalis": {"shear_pa": 900, "shear_along_pa": 800}})"),
              "rig.json:/mentalis/shear_along_pa: expected no less than shear_pa, 900, found 800");
}

TEST(SolidMuscles, MistakesAreNamedWithWhatWasExpected) {
    EXPECT_EQ(
        message_of(R"({"maseter_superficial": {}})"),
        "rig.json:/maseter_superficial: expected a muscle of the table of muscles (did you mean "
        "\"masseter_superficial\"?), found \"maseter_superficial\"");
    EXPECT_EQ(message_of(R"({"mentalis": {"strenght": 1}})"),
              "rig.json:/mentalis/strenght: expected a known key (did you mean \"strength\"?), "
              "found unknown key "
              "\"strenght\"");
    EXPECT_EQ(
        message_of(R"({"mentalis": {"ends": [1]}})"),
        "rig.json:/mentalis/ends: expected two ratios, of the origin and the insertion, found [1]");
    EXPECT_EQ(message_of(R"({"mentalis": {"volume_pa": 0}})"),
              "rig.json:/mentalis/volume_pa: expected [1, 1e+10], found 0");
    EXPECT_EQ(message_of(R"({"levator_palpebrae_superioris": {}})"),
              "rig.json:/levator_palpebrae_superioris: expected a muscle of the face or the jaw, "
              "found \"levator_palpebrae_superioris\", of the group lid");
    EXPECT_EQ(message_of(R"({"orbicularis_oris_lower_peripheral": {}})"),
              "rig.json:/orbicularis_oris_lower_peripheral: expected the other half of the ring, "
              "\"orbicularis_oris_upper_peripheral\", too, found this half alone");
}

}  // namespace
}  // namespace risorius::rig
