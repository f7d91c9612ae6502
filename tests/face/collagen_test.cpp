// SPDX-License-Identifier: MIT
// Regions of fibres make the tissue of a face stiffer along themselves, and leave the rest as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "face/adult_face.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/fields.h"
#include "risorius/face/statics.h"
#include "risorius/tissue/point_springs.h"

namespace risorius::face {
namespace {

/// A region beside the left nasolabial fold, from the corner of the mouth towards the ear.
rig::RigDescription with_fibres(double k1_pa, const std::string& layer = "both") {
    rig::RigDescription rig = rig::adult().rig;
    rig.tissue.collagen = {{.at = "nl3_l",
                            .radius_mm = 30,
                            .layer = layer,
                            .from = "ch_l",
                            .to = "t_l",
                            .k1_pa = k1_pa,
                            .k2 = 2}};
    return rig;
}

Face face_of(const rig::RigDescription& rig) {
    return Face(rig, rig::adult().mesh, preview(), "adult");
}

Vec3 fibre_way(const Face& face) {
    return Vec3(face.head().landmark("t_l") - face.head().landmark("ch_l")).normalized();
}

/// How far a spring to a place 10 mm away moves the skin in the middle of the region, mm.
double moved_by_spring_mm(const rig::RigDescription& rig, bool along) {
    Face face = face_of(rig);
    const Vec3 p = face.head().landmark("nl3_l"), way = fibre_way(face);
    const Points skin = face.diagnostics().rest_skin_nodes();
    long nearest = 0;
    (skin.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    const int node = node_of(static_cast<int>(nearest), kSkin);
    const Vec3 up = (Vec3::UnitY() - Vec3::UnitY().dot(way) * way).normalized();
    const auto spring = std::make_shared<tissue::InteractiveSpring>(60, 0.5);
    face.add_force(spring);
    face.start(always(neutral()));
    const auto position = [&] { return Vec3(face.statics().nodes().row(node).transpose()); };
    const Vec3 rest = position(), to = along ? -way : up;
    spring->attach(solve::NodeBlend(node), rest + 10e-3 * to);
    for (int i = 0; i < 30; ++i) face.step(always(neutral()));
    return 1e3 * (position() - rest).dot(to);
}

TEST(CollagenFibres, MakeTheTissueStifferAlongThemselves) {
    const rig::RigDescription plain = rig::adult().rig, fibrous = with_fibres(8000);
    const double along = moved_by_spring_mm(fibrous, true) / moved_by_spring_mm(plain, true),
                 across = moved_by_spring_mm(fibrous, false) / moved_by_spring_mm(plain, false);
    EXPECT_LT(along, 0.8);
    EXPECT_GT(across, 0.9);
    EXPECT_LT(across, 1.02);
    const double skin_only = moved_by_spring_mm(with_fibres(8000, "superficial"), true) /
                             moved_by_spring_mm(plain, true);
    EXPECT_GT(skin_only, along);
    EXPECT_LT(skin_only, 0.95);
}

TEST(CollagenFibres, LeaveTheFaceAtRestAndItsEquilibriaFindable) {
    Face face = face_of(with_fibres(8000));
    const Points rest = face.statics().nodes();
    const Points gradient = face.statics().gradient(rest, neutral().excitation, neutral()),
                 usual = adult_face().statics().gradient(rest, neutral().excitation, neutral());
    EXPECT_LT((gradient - usual).cwiseAbs().maxCoeff(), 1e-9);
    StepStats figures;
    const FacePose smile = equilibrium_pose(face, with_unit("AU12"), &figures, kNearRest);
    EXPECT_TRUE(figures.converged);
    Face plain = adult_face();
    const FacePose plain_smile = equilibrium_pose(plain, with_unit("AU12"), nullptr, kNearRest);
    const auto corner_mm = [&](const FacePose& pose, const char* corner) {
        return 1e3 * (at(pose.vertices, corner) - at(face.head().vertices, corner)).norm();
    };
    // The left corner goes another way. The right one, to which the ring of the lips ties it, changes less
    const auto change_mm = [&](const char* corner) {
        return std::abs(corner_mm(smile, corner) - corner_mm(plain_smile, corner));
    };
    EXPECT_GT(change_mm("ch_l"), 1);
    EXPECT_LT(change_mm("ch_r"), 0.7 * change_mm("ch_l"));
    // Steps come to the same place
    const track::Drive drive = with_unit("AU12");
    face.start(always(neutral()));
    for (int i = 0; i < 90; ++i) face.step(always(drive));
    EXPECT_LT(1e3 * (at(face.pose().vertices, "ch_l") - at(smile.vertices, "ch_l")).norm(), 0.3);
}

TEST(CollagenFibres, AreInTheStressOfTheTissue) {
    Face plain = adult_face(), fibrous = face_of(with_fibres(8000));
    const auto tension_pa = [&](Face& face) {
        equilibrium_pose(face, with_unit("AU20"), nullptr, kWithinATenth);
        return face.fields().now().tissue.stress_pa.leftCols(3).maxCoeff();
    };
    EXPECT_GT(tension_pa(fibrous), 1.1 * tension_pa(plain));
}

}  // namespace
}  // namespace risorius::face
