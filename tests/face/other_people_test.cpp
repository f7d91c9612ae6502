// SPDX-License-Identifier: MIT
// The measured head as other people: the face is built of them, their bone stays under their skin, and they move.
#include <gtest/gtest.h>

#include "face/adult_face.h"
#include "rig/head_variants.h"
#include "risorius/face/anatomy/inside_skin.h"
#include "risorius/face/anatomy/tissue_mesh.h"

namespace risorius::face {
namespace {

// The first left islands of skin at the corners of its mouth, whose vertices moved to NaN; the other is in a corner of what
// two standard deviations allow. Both drawn once.
const std::vector<double> kIslands{.23,  -1, -.61, -1.07, 1.95, -1.63, -.71, -.92, -.34, -.81,
                                   1.08, .5, -.38, .85,   1.19, -.2,   0,    -.85, .89,  1.18},
    kCorner{-2, -2, 2, 2, 2, 2, -2, -2, -2, -2, -2, 2, -2, -2, -2, -2, 2, -2, -2, 2};

TEST(OtherPeople, EveryPointOfTheSimulatedSkinCarriesSkinAndItsBoneLiesInside) {
    const auto ict = rig::ict_head();
    if (!ict) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const rig::Head head =
        rig::place_head(ict->rig, rig::with_identity(ict->mesh, kIslands), "person");
    const std::array<EyeLids, 2> lids{EyeLids(head, 0, 0.96), EyeLids(head, 1, 0.96)};
    const Jaw jaw(head, ict->rig.jaw);
    const Shell shell = build_shell(head, jaw, lids, {});
    const TissueMesh tissue = build_tissue_mesh(head, ict->rig, shell, lids);
    for (const double area : tissue.area_m2) ASSERT_GT(area, 0);
    const auto layer = [&](Layer which) {
        Points out(static_cast<long>(shell.vertex.size()), 3);
        for (long v = 0; v < out.rows(); ++v)
            out.row(v) = tissue.nodes.row(node_of(static_cast<int>(v), which));
        return out;
    };
    const InsideSkin skin(layer(kSkin), shell.triangles);
    const Points bone = layer(kDeep);
    for (long v = 0; v < bone.rows(); ++v)
        EXPECT_FALSE(skin.outside(bone.row(v).transpose()))
            << 1e3 * bone.row(v) / head.size << " mm";
    EXPECT_LT(tissue.dropped_tets, tissue.tets.rows() / 50);
}

TEST(OtherPeople, MoveAndStayWhole) {
    const auto ict = rig::ict_head();
    if (!ict) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const auto look_at = [&](const std::vector<double>& sigmas, int vertices,
                             const std::vector<std::string>& units) {
        Quality quality = preview();
        quality.shell_vertices = vertices;
        Face face(ict->rig, rig::with_identity(ict->mesh, sigmas), quality, "person");
        const Points rest = face.pose().vertices;
        ASSERT_TRUE(rest.allFinite());
        for (const std::string& unit : units) {
            StepStats figures;
            const Points moved = equilibrium_pose(face, with_unit(unit), &figures).vertices;
            ASSERT_TRUE(moved.allFinite()) << unit;
            // Lips that slide over teeth may still creep by some tenths of a millimetre
            EXPECT_LT(figures.last_step_rms_m, 0.4e-3) << unit;
            const double farthest_mm = 1e3 * (moved - rest).rowwise().norm().maxCoeff();
            EXPECT_GT(farthest_mm, 4) << unit;
            EXPECT_LT(farthest_mm, 60) << unit;
            EXPECT_LT(face.diagnostics().inverted_tets(), face.diagnostics().tet_count() / 60)
                << unit;
        }
    };
    look_at(kIslands, 800, {"AU26"});
    look_at(kCorner, 300, {"AU12", "AU27", "AU45", "AU18", "AU15"});
}

TEST(InsideSkin, TissueBetweenTwoSkinsEndsBeforeTheOther) {
    // Two sheets 4 mm apart that face away from each other, as in the wing of a nose
    Points points(8, 3);
    points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, -.4, 0, 1, -.4, 1, 1, -.4, 1, 0, -.4;
    points *= 0.01;
    Triangles triangles(4, 3);
    triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
    const InsideSkin skin(points, triangles);
    const Vec3 at(0.004, 0.0051, 0), up = Vec3::UnitZ();
    EXPECT_FALSE(skin.outside(at - 0.001 * up));
    EXPECT_TRUE(skin.outside(at + 0.001 * up));
    EXPECT_TRUE(skin.outside(at - 0.005 * up));
    EXPECT_EQ(skin.depth(at, up, 0.001, 0.0002), 0.001);
    // No nearer to the other skin than half the depth: 2/3 of the way, less the steps of a search
    const double depth = skin.depth(at, up, 0.010, 0.0002);
    EXPECT_LT(depth, 0.0027);
    EXPECT_GT(depth, 0.0023);
}

}  // namespace
}  // namespace risorius::face
