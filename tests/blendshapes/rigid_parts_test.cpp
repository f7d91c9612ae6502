// SPDX-License-Identifier: MIT
// Teeth and eyes are found by role, by name, and as loose pieces in the mouth; what bends them is measured.
#include "risorius/blendshapes/detail/rigid_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace risorius::blendshapes {
namespace {

/// Tetrahedra: in each group one on the skin, or where `places` puts them.
struct Pieces {
    rig::Head head;
    geom::PolygonMesh mesh;

    void add(const std::string& group, const std::string& role, const std::vector<Vec3>& places) {
        mesh.group_names.push_back(group);
        head.role_of_group.push_back(role);
        for (const Vec3& place : places) {
            const auto first = static_cast<int>(head.vertices.rows());
            head.vertices.conservativeResize(first + 4, 3);
            head.vertices.row(first) = place.transpose();
            for (int k = 0; k < 3; ++k)
                head.vertices.row(first + 1 + k) = (place + 4e-3 * Vec3::Unit(k)).transpose();
            for (int skipped = 0; skipped < 4; ++skipped) {
                for (int k = 0; k < 4; ++k)
                    if (k != skipped) mesh.corner_vertex.push_back(first + k);
                mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
                mesh.face_group.push_back(static_cast<int>(mesh.group_names.size()) - 1);
            }
            for (int k = 0; k < 4; ++k) head.welded.push_back(first + k);
        }
        mesh.positions = head.vertices;
        head.landmarks["sto"] = Vec3(0, -0.05, 0.1);
    }
};

TEST(RigidParts, AreTeethAndEyesByRoleOrNameAndLoosePiecesInTheMouth) {
    Pieces made;
    const Vec3 mouth(0, -0.05, 0.08), brow(0.03, 0.04, 0.1), before(0, -0.05, 0.12);
    made.add("head", "skin", {brow, mouth, before});
    made.add("a", "teeth_upper", {mouth, mouth + Vec3(0.01, 0, 0)});
    made.add("b", "eye_l", {brow});
    made.add("LowerTooth_3", "", {mouth});
    made.add("eyebrows", "", {brow});
    made.add("eye_socket", "eye_socket", {brow});
    made.add("gums", "gums_upper", {mouth});
    const std::vector<std::vector<int>> parts = rigid_parts(made.head, made.mesh);
    ASSERT_EQ(parts.size(), 5u);
    EXPECT_EQ(parts[0].front(), 4);   // the loose piece of the skin
    EXPECT_EQ(parts[1].front(), 12);  // two teeth
    EXPECT_EQ(parts[2].front(), 16);
    EXPECT_EQ(parts[3].front(), 20);  // the eye
    EXPECT_EQ(parts[4].front(), 24);  // the tooth that only its name tells
}

TEST(RigidParts, MayTurnButNotBend) {
    Pieces made;
    made.add("teeth", "teeth_upper", {Vec3(0, -0.05, 0.08), Vec3(0.02, -0.05, 0.08)});
    const std::vector<std::vector<int>> parts = rigid_parts(made.head, made.mesh);
    const Points& rest = made.head.vertices;
    const Rigid turn = Eigen::Translation3d(0.01, 0, 0) * Eigen::AngleAxisd(0.4, Vec3::UnitX());
    Points moved = rest;
    for (long v = 0; v < 4; ++v) moved.row(v) = (turn * Vec3(rest.row(v).transpose())).transpose();
    EXPECT_LT(bent_by_m(parts, rest, moved), 1e-12);  // each by itself
    moved(5, 0) += 1e-3;
    EXPECT_GT(bent_by_m(parts, rest, moved), 0.2e-3);
    EXPECT_LT(bent_by_m(parts, rest, moved), 1e-3);
    EXPECT_EQ(bent_by_m({}, rest, moved), 0.0);
}

}  // namespace
}  // namespace risorius::blendshapes
