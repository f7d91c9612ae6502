// SPDX-License-Identifier: MIT
#include "risorius/fitting/part_guess.h"

#include <gtest/gtest.h>

#include "risorius/fitting/detail/mesh_parts.h"

namespace risorius::fitting {
namespace {

TEST(PartGuess, KnowsTheNamesThatModelsUse) {
    for (const auto& [group, role] : std::vector<std::pair<const char*, const char*>>{
             {"face", "skin"},
             {"head_neck", "skin"},
             {"Body", "skin"},
             {"EyelidUpper", "skin"},
             {"mouth_socket", "mouth"},
             {"OralCavity", "mouth"},
             {"eye_socket_l", "eye_socket"},
             {"eyeball_l", "eye_l"},
             {"RightEye", "eye_r"},
             {"Eye_R", "eye_r"},
             {"eyes", "eye"},
             {"cornea_l", "cornea_l"},
             {"teeth", "teeth"},
             {"UpperTeeth", "teeth_upper"},
             {"teeth_lower", "teeth_lower"},
             {"gums_tongue", "gums_tongue"},
             {"gums_upper", "gums_upper"},
             {"Tongue", "tongue"},
             {"lashes_r", "lashes_r"},
             {"EyelashesLeft", "lashes_l"},
             {"eyebrows", "hidden"},
             {"lacrimal_l", "hidden"},
             {"eyeocclusion_r", "hidden"},
             {"eyeblend_l", "hidden"},
             {"polySurface12", ""},
             // MetaHuman
             {"head_lod0_mesh", "skin"},
             {"eyeLeft_lod0_mesh", "eye_l"},
             {"eyeshell_lod0_mesh", "hidden"},
             {"saliva_lod0_mesh", "hidden"},
             // VRoid
             {"Face.N00_000_00_FaceMouth_00_FACE", "mouth"},
             {"Face.N00_000_00_EyeIris_00_EYE", "eye"},
             {"Face.N00_000_00_EyeHighlight_00_EYE", "hidden"},
             {"Face.N00_000_00_Face_00_SKIN", "skin"},
             // Character Creator
             {"CC_Base_Body.Std_Eyelash", "lashes"},
             {"CC_Base_Eye.Std_Cornea_L", "cornea_l"},
             {"CC_Base_Teeth.Std_Upper_Teeth", "teeth_upper"},
             {"CC_Base_TearLine", "hidden"},
             // MakeHuman
             {"human:High-Poly", "eye"},
             {"human:teeth_base", "teeth"}})
        EXPECT_EQ(role_suggested_by(group), role) << group;
}

/// One triangle per group, at x.
geom::PolygonMesh triangles(const std::vector<std::pair<std::string, double>>& groups) {
    geom::PolygonMesh mesh;
    mesh.positions.resize(static_cast<long>(3 * groups.size()), 3);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        mesh.group_names.push_back(groups[g].first);
        mesh.face_group.push_back(static_cast<int>(g));
        for (int k = 0; k < 3; ++k) {
            const int v = static_cast<int>(3 * g) + k;
            mesh.positions.row(v) << groups[g].second, k == 1, k == 2;
            mesh.corner_vertex.push_back(v);
        }
        mesh.face_begin.push_back(static_cast<int>(3 * (g + 1)));
    }
    return mesh;
}

const auto kLeftIsPositive = [](const Vec3& p) { return p.x(); };

TEST(PartGuess, TakesTheOnlyGroupAsSkin) {
    const PartGuess guess = guess_parts(triangles({{"polySurface1", 0}}), {}, kLeftIsPositive);
    EXPECT_EQ(guess.parts.at("skin"), std::vector<std::string>{"polySurface1"});
    EXPECT_TRUE(guess.notes.empty());
}

TEST(PartGuess, TellsEyesWithoutASideByWhereTheyLie) {
    const PartGuess guess =
        guess_parts(triangles({{"head", 0}, {"eye1", 3}, {"eye2", -3}}), {}, kLeftIsPositive);
    EXPECT_EQ(guess.parts.at("eye_l"), std::vector<std::string>{"eye1"});
    EXPECT_EQ(guess.parts.at("eye_r"), std::vector<std::string>{"eye2"});
    ASSERT_EQ(guess.notes.size(), 2u);
    EXPECT_EQ(guess.notes[0], "group \"eye1\" taken as eye_l, by where it lies");
}

TEST(MeshParts, OneGroupWithBothEyesBecomesTwo) {
    geom::PolygonMesh mesh = triangles({{"head", 0}, {"Eyes", 3}, {"b", -3}});
    mesh.face_group[2] = 1;
    mesh.group_names.pop_back();
    EXPECT_EQ(split_sides(mesh, {}, kLeftIsPositive).size(), 1u);
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"head", "Eyes_l", "Eyes_r"}));
    EXPECT_EQ(mesh.face_group, (std::vector<int>{0, 1, 2}));
    EXPECT_TRUE(split_sides(mesh, {}, kLeftIsPositive).empty());
}

TEST(MeshParts, MaterialsOfOneObjectAreParts) {
    geom::PolygonMesh mesh = triangles({{"Character", 0}, {"b", 3}, {"c", -3}});
    mesh.group_names = {"Character"};
    mesh.face_group = {0, 0, 0};
    mesh.material_names = {"Std_skin", "Std_eye_l", "Std_teeth"};
    mesh.face_material = {0, 1, 2};
    split_materials(mesh, {});
    EXPECT_EQ(mesh.group_names,
              (std::vector<std::string>{"Character.Std_skin", "Character.Std_eye_l",
                                        "Character.Std_teeth"}));
    // Materials of one part do not divide it.
    mesh.group_names = {"head"};
    mesh.face_group = {0, 0, 0};
    mesh.material_names = {"skin", "lips", "ears"};
    split_materials(mesh, {});
    EXPECT_EQ(mesh.group_names, std::vector<std::string>{"head"});
}

TEST(MeshParts, ABodyBelowTheNeckIsHidden) {
    const auto as_it_is = [](const Vec3& p) { return p; };
    geom::PolygonMesh mesh = triangles({{"body", 0}, {"b", 0}});
    mesh.group_names = {"body"};
    mesh.face_group = {0, 0};
    const geom::PolygonMesh head = mesh;
    for (int k = 3; k < 6; ++k) mesh.positions(k, 1) -= 2;
    EXPECT_EQ(hide_body(mesh, {"body"}, as_it_is, Vec3::Zero(), 1), 1);
    EXPECT_EQ(mesh.face_group, (std::vector<int>{0, 1}));
    mesh = head;
    EXPECT_EQ(hide_body(mesh, {"body"}, as_it_is, Vec3::Zero(), 1), 0);
}

TEST(PartGuess, HidesWhatItDoesNotKnowAndSaysSo) {
    const PartGuess guess =
        guess_parts(triangles({{"head", 0}, {"object7", 0}}), {}, kLeftIsPositive);
    EXPECT_EQ(guess.parts.at("hidden"), std::vector<std::string>{"object7"});
    ASSERT_EQ(guess.notes.size(), 1u);
    EXPECT_EQ(guess.notes[0],
              "group \"object7\" is hidden: its name says no part (the option part gives it one: "
              "role=object7)");
}

TEST(PartGuess, WhatIsGivenWins) {
    const PartGuess guess = guess_parts(triangles({{"head", 0}, {"tongue", 0}}),
                                        {{"gums", {"tongue"}}}, kLeftIsPositive);
    EXPECT_EQ(guess.parts.at("gums"), std::vector<std::string>{"tongue"});
    EXPECT_FALSE(guess.parts.contains("tongue"));
}

}  // namespace
}  // namespace risorius::fitting
