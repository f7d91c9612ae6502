// SPDX-License-Identifier: MIT
// Pieces of a head without groups are told from where they lie.
#include "risorius/fitting/detail/piece_guess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "rig/head_variants.h"

namespace risorius::fitting {
namespace {

Vec3 as_it_is(const Vec3& p) { return p; }

/// The adult in the head frame with all its parts in one group.
geom::PolygonMesh nameless() {
    geom::PolygonMesh mesh = rig::adult().mesh;
    mesh.positions = rig::adult_placed().vertices;
    mesh.group_names = {"default"};
    std::fill(mesh.face_group.begin(), mesh.face_group.end(), 0);
    return mesh;
}

TEST(PieceGuess, FindsEyesTeethAndTongueOfAHeadWithoutGroups) {
    for (const bool soup : {false, true}) {
        geom::PolygonMesh mesh = soup ? rig::soup_of(nameless()) : nameless();
        EXPECT_FALSE(group_pieces(mesh, as_it_is, rig::adult_placed().landmarks, 1.0).empty());
        for (const char* name : {"skin", "eye_l", "eye_r", "teeth", "tongue"})
            EXPECT_GE(mesh.group_index(name), 0) << name;
        // Eyes are behind their own lids, and skin is what it was
        for (const auto& [name, sign] : {std::pair{"eye_l", 1.0}, std::pair{"eye_r", -1.0}}) {
            const Triangles eye = geom::triangulate(mesh, {mesh.group_index(name)});
            for (long f = 0; f < eye.rows(); ++f)
                EXPECT_GT(sign * mesh.positions(eye(f, 0), 0), 15e-3);
        }
        const Triangles skin = geom::triangulate(mesh, {mesh.group_index("skin")});
        const long whole = rig::adult_placed().skin.rows() + rig::adult_placed().lining.rows();
        EXPECT_GE(skin.rows(), whole);
        EXPECT_LT(skin.rows(), 1.05 * whole);  // lashes that touch the lids are taken for skin
    }
}

TEST(PieceGuess, LeavesGroupsAndSinglePiecesAlone) {
    geom::PolygonMesh grouped = rig::adult().mesh;
    EXPECT_TRUE(group_pieces(grouped, as_it_is, rig::adult_placed().landmarks, 1.0).empty());
    EXPECT_EQ(grouped.group_names, rig::adult().mesh.group_names);
    geom::PolygonMesh scan = rig::scan_of(rig::adult_placed(), rig::adult().mesh, 20, 20);
    EXPECT_TRUE(group_pieces(scan, as_it_is, rig::adult_placed().landmarks, 1.0).empty());
    EXPECT_EQ(scan.group_names, std::vector<std::string>{"scan"});
}

}  // namespace
}  // namespace risorius::fitting
