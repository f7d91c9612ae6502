// SPDX-License-Identifier: MIT
// Bones in the scene: one array, the mandible moved by the jaw, both by the head.
#include <gtest/gtest.h>

#include "risorius/scene/scene_from_rig.h"

namespace risorius::scene {
namespace {

TEST(BonesInScene, TheMandibleMovesWithTheJawAndBothWithTheHead) {
    face::Skull skull;
    skull.cranium.vertices = Points::Random(4, 3);
    skull.mandible.vertices = Points::Random(5, 3);
    skull.cranium.triangles.resize(1, 3);
    skull.cranium.triangles << 1, 2, 3;
    skull.mandible.triangles.resize(1, 3);
    skull.mandible.triangles << 0, 2, 4;
    skull.cranium.open.assign(4, 0.5);
    skull.mandible.open.assign(5, 1.0);
    const render::Bones bones = bones_for_view(skull);
    ASSERT_EQ(bones.rest.rows(), 9);
    EXPECT_EQ(bones.rest.topRows(4), skull.cranium.vertices);
    EXPECT_EQ(bones.triangles.row(1), Triangles::RowXpr::PlainObject(4, 6, 8));
    EXPECT_EQ(bones.open[3], 0.5);
    EXPECT_EQ(bones.open[4], 1.0);

    face::FacePose face;
    face.mandible = Eigen::Translation3d(0, -0.01, 0) * Eigen::AngleAxisd(0.4, Vec3::UnitX());
    face.head = Eigen::Translation3d(0.02, 0, 0) * Eigen::AngleAxisd(0.3, Vec3::UnitY());
    render::Pose pose;
    add_bones(skull, face, pose);
    for (long v = 0; v < 9; ++v) {
        const Vec3 rest = bones.rest.row(v).transpose();
        const Vec3 wanted = v < 4 ? face.head * rest : face.head * (face.mandible * rest);
        EXPECT_LT((pose.bone_positions.row(v).transpose() - wanted).norm(), 1e-12) << v;
    }
}

}  // namespace
}  // namespace risorius::scene
