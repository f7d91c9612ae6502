// SPDX-License-Identifier: MIT
// Depths of furrows and contact of lips: by hand on profiles, and on poses whose furrows and gaps are made on purpose.
#include "risorius/scene/detail/skin_readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "risorius/face/face.h"
#include "risorius/face/quality.h"
#include "risorius/face/surfaces.h"
#include "scene/adult_of_bundles.h"

namespace risorius::scene {
namespace {

TEST(SkinReadings, DepthOfAProfileIsThatBelowItsHull) {
    // A notch of 2 mm in a flat line
    EXPECT_NEAR(
        depth_below_hull({{0, 0, 0}, {4, 0, 0}, {5, 0, -2}, {6, 0, 0}, {10, 0, 0}}, Vec3::UnitZ()),
        2, 1e-12);
    // A bank beside it counts: the hull goes from the foot at x = 0 to the bank of 3 mm at x = 6
    EXPECT_NEAR(depth_below_hull({{0, 0, 0}, {3, 0, -1}, {6, 0, 3}, {10, 0, 0}}, Vec3::UnitZ()),
                2.5, 1e-12);
    // A round cheek has no furrow, whichever way the whole profile is tilted
    std::vector<Vec3> round, tilted;
    for (int i = 0; i <= 20; ++i) {
        const double angle = std::numbers::pi * i / 20;
        round.emplace_back(-std::cos(angle), 0, std::sin(angle));
        tilted.push_back(Eigen::AngleAxisd(0.4, Vec3::UnitY()) * round.back());
    }
    EXPECT_NEAR(depth_below_hull(round, Vec3::UnitZ()), 0, 1e-12);
    EXPECT_NEAR(depth_below_hull(tilted, Vec3::UnitZ()), 0, 1e-12);
    // Skin that folds back over its furrow
    EXPECT_NEAR(
        depth_below_hull({{0, 0, 0}, {5, 0, 0}, {4, 0, -3}, {6, 0, -3}, {5.5, 0, 0}, {10, 0, 0}},
                         Vec3::UnitZ()),
        3, 1e-12);
}

struct AdultSkin {
    const RigFiles& files = adult_of_bundles();
    face::Face face{files.rig, files.mesh, face::quality_named("preview"), files.place()};
    SkinReader reader{face, files.rig};
    face::FacePose pose = face.surfaces().posed(face.head().vertices, drive());

    track::Drive drive() const {
        track::Drive out;
        out.excitation = Eigen::VectorXd::Zero(files.rig.channels().column_count());
        return out;
    }
    Vec3 at(const char* id) const { return face.head().landmark(id); }
};

AdultSkin& adult_skin() {
    static AdultSkin skin;
    return skin;
}

TEST(SkinReadings, AGrooveAlongTheNasolabialFoldIsReadThereAndNowhereElse) {
    AdultSkin& adult = adult_skin();
    face::FacePose grooved = adult.pose;
    const Vec3 from = adult.at("nl1_l"), to = adult.at("nl3_l");
    constexpr double kDepth_mm = 3;
    for (int v = 0; v < grooved.vertices.rows(); ++v) {
        const Vec3 p = grooved.vertices.row(v).transpose();
        const double part = (p - from).dot(to - from) / (to - from).squaredNorm();
        const Vec3 foot = from + std::clamp(part, 0.0, 1.0) * (to - from);
        const double far_mm = 1e3 * (p - foot).norm();
        grooved.vertices.row(v) -=
            1e-3 * kDepth_mm * std::exp(-far_mm * far_mm / 9) * Vec3::UnitZ().transpose();
    }
    const auto change = [&](Furrow furrow) {
        return adult.reader.furrow_mm(furrow, grooved) - adult.reader.furrow_mm(furrow, adult.pose);
    };
    EXPECT_GT(change(Furrow::kNasolabial), 0.5 * kDepth_mm);
    EXPECT_LT(change(Furrow::kNasolabial), kDepth_mm);
    EXPECT_NEAR(change(Furrow::kGlabellar), 0, 1e-6);
    EXPECT_NEAR(change(Furrow::kForehead), 0, 1e-6);
}

TEST(SkinReadings, WrinklesFinerThanTheMeshCountAtTheirPlace) {
    AdultSkin& adult = adult_skin();
    face::FacePose wrinkled = adult.pose;
    wrinkled.fold_depth = Points::Zero(wrinkled.vertices.rows(), 3);
    const auto read = [&](Furrow furrow) { return adult.reader.furrow_mm(furrow, wrinkled); };
    const std::array<double, 3> smooth{read(Furrow::kNasolabial), read(Furrow::kGlabellar),
                                       read(Furrow::kForehead)};
    const double above_m = adult.at("tr").y() - adult.face.head().mm(30);
    int slot_of_forehead = -1;
    for (const rig::WrinklePattern& one : adult.files.rig.atlas.wrinkles)
        if (one.name == "forehead") slot_of_forehead = one.slot;
    ASSERT_GE(slot_of_forehead, 0);
    for (int v = 0; v < wrinkled.vertices.rows(); ++v)
        if (std::abs(wrinkled.vertices(v, 1) - above_m) < adult.face.head().mm(8))
            wrinkled.fold_depth(v, slot_of_forehead) = 0.7e-3;
    EXPECT_NEAR(read(Furrow::kForehead), smooth[2] + 0.7, 1e-9);
    EXPECT_NEAR(read(Furrow::kGlabellar), smooth[1], 1e-9);
    EXPECT_NEAR(read(Furrow::kNasolabial), smooth[0], 1e-9);
}

TEST(SkinReadings, LipsTouchUntilTheyPart) {
    AdultSkin& adult = adult_skin();
    const double shut = adult.reader.lip_contact_mm2(adult.pose);
    EXPECT_GT(shut, 2);
    track::Drive parting = adult.drive();
    for (const Side side : {Side::kLeft, Side::kRight})
        parting.excitation[adult.files.rig.channels().column("depressor_labii_inferioris", side)] =
            0.5;
    adult.face.start([&](double) { return adult.drive(); });
    ASSERT_TRUE(adult.face.solve_equilibrium(parting.excitation, parting).converged);
    const face::FacePose parted = adult.face.pose();
    EXPECT_LT(adult.reader.lip_contact_mm2(parted), 0.2 * shut);
}

}  // namespace
}  // namespace risorius::scene
