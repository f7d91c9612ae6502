// SPDX-License-Identifier: MIT
// A smile folds the skin beside the mouth; the cheek behind the fold moves as one.
#include "risorius/face/anatomy/detail/cheek.h"

#include <gtest/gtest.h>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

const rig::Head& head() { return rig::adult_placed(); }

TEST(Cheek, HasACreaseBesideTheFoldAndFatBelowTheCheekbone) {
    const CheekRegions cheek(head());
    for (const double side : {1.0, -1.0}) {
        const std::string end = side > 0 ? "_l" : "_r";
        const Vec3 beside_fold =
            head().landmark("nl2" + end) + Vec3(side * head().mm(4), head().mm(2.4), 0);
        const Vec3 pad =
            head().landmark("ma" + end) + Vec3(-side * head().mm(2), head().mm(-10), 0);
        EXPECT_NEAR(cheek.crease(beside_fold), 1, 1e-12);
        EXPECT_EQ(cheek.fat(beside_fold), 0);
        EXPECT_NEAR(cheek.fat(pad), 1, 1e-12);
        EXPECT_EQ(cheek.crease(pad), 0);
    }
    for (const char* elsewhere : {"ls", "pg", "g", "ps_l", "zy_l"}) {
        EXPECT_EQ(cheek.crease(head().landmark(elsewhere)), 0) << elsewhere;
        EXPECT_EQ(cheek.fat(head().landmark(elsewhere)), 0) << elsewhere;
    }
}

// Skin point nearest to p, of the mesh.
int nearest(const Face& face, const Vec3& p) {
    const Triangles& skin = face.surfaces().simulated_skin();
    int best = skin(0, 0);
    for (long i = 0; i < skin.size(); ++i)
        if ((face.head().vertices.row(skin.data()[i]).transpose() - p).squaredNorm() <
            (face.head().vertices.row(best).transpose() - p).squaredNorm())
            best = skin.data()[i];
    return best;
}

TEST(Cheek, ShortensAcrossTheFoldInASmileMoreThanBehindIt) {
    // With bundles of fibres throughout, as heads are fitted
    rig::RigDescription rig = rig::adult().rig;
    rig.solids.clear();
    Face face(rig, rig::adult().mesh, preview(), "adult");
    const Points after = equilibrium_pose(face, with_unit("AU12")).vertices;
    // From the fold half-way between its middle and its lower end, outwards and up
    const Vec3 fold = 0.5 * (head().landmark("nl2_l") + head().landmark("nl3_l"));
    const auto stretch = [&](double from_mm, double to_mm) {
        const Vec3 along = Vec3(1, 0.6, -0.7).normalized();
        const int a = nearest(face, fold + head().mm(from_mm) * along),
                  b = nearest(face, fold + head().mm(to_mm) * along);
        return (after.row(a) - after.row(b)).norm() /
               (head().vertices.row(a) - head().vertices.row(b)).norm();
    };
    EXPECT_LT(stretch(-4, 8), 0.9);
    EXPECT_LT(stretch(-4, 8), stretch(12, 28));
}

}  // namespace
}  // namespace risorius::face
