// SPDX-License-Identifier: MIT
// The cords of the neck: a string on a bed, and what it raises on a head.
#include "risorius/face/skin/detail/platysma_cords.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

struct Arc {
    std::vector<Vec3> stations, outward;
    double spacing_m;
};
// A shallow arc of constant curvature, hollow as seen from outside when that is > 0.
Arc arc(int count, double spacing_m, double curvature_per_m) {
    Arc out{{}, {}, spacing_m};
    for (int i = 0; i < count; ++i) {
        const double s = (i - 0.5 * (count - 1)) * spacing_m;
        out.stations.push_back({0, s, 0.5 * curvature_per_m * s * s});
        out.outward.push_back(Vec3::UnitZ());
    }
    return out;
}

TEST(PlatysmaCords, AStringStandsOffAHollowAsItsEquationSays) {
    const double tension = 2.0, bed = 8000, curvature = 20;
    const Arc hollow = arc(101, 1e-3, curvature);
    const auto height =
        string_heights(hollow.stations, hollow.outward, hollow.spacing_m, tension, bed);
    const double per_m = std::sqrt(bed / tension), half = 0.05;
    for (int i = 0; i < 101; ++i) {
        const double s = (i - 50) * 1e-3;
        const double exact =
            tension * curvature / bed * (1 - std::cosh(per_m * s) / std::cosh(per_m * half));
        EXPECT_NEAR(height[static_cast<std::size_t>(i)], exact, 1e-3 * 5e-3) << i;
    }
}

TEST(PlatysmaCords, AStringNeitherPressesIntoARoundingNorStandsOffWithoutPull) {
    const Arc round = arc(31, 4e-3, -20), hollow = arc(31, 4e-3, 20);
    for (const double h : string_heights(round.stations, round.outward, round.spacing_m, 2, 8000))
        EXPECT_EQ(h, 0);
    for (const double h :
         string_heights(hollow.stations, hollow.outward, hollow.spacing_m, 0, 8000))
        EXPECT_EQ(h, 0);
}

TEST(PlatysmaCords, StandOutFromTheNeckOfTheSideThatPullsAndFromNothingElse) {
    const rig::RigDescription& rig = rig::adult().rig;
    const rig::Head head = rig::place_head(rig, rig::adult().mesh, "adult");
    const PlatysmaCords cords(head, rig);
    ASSERT_EQ(cords.lines().size(), 4U) << "two borders on each side";
    const track::ChannelTable channels = rig.channels();
    Eigen::VectorXd activation = Eigen::VectorXd::Zero(channels.column_count());
    Points vertices = head.vertices, depth(0, 3);
    cords.raise(activation, vertices, depth);
    EXPECT_EQ(vertices, head.vertices);

    activation[channels.column("platysma", Side::kLeft)] = 1;
    cords.raise(activation, vertices, depth);
    double max = 0;
    for (long v = 0; v < vertices.rows(); ++v) {
        const Vec3 rest = head.vertices.row(v);
        const double moved = (vertices.row(v) - head.vertices.row(v)).norm();
        max = std::max(max, moved);
        if (moved > 0.1e-3) {
            EXPECT_GT(rest.x(), 0) << v;
            EXPECT_LT(rest.y(), head.landmark("ch_l").y()) << v;
        }
    }
    EXPECT_GT(1e3 * max, 1.5) << "mm";
    EXPECT_LT(1e3 * max, 7.0) << "mm";

    // Twice the pull on a bed that gives way in proportion: never more than twice the height
    activation *= 0.5;
    Points half = head.vertices;
    cords.raise(activation, half, depth);
    const double at_half = (half - head.vertices).rowwise().norm().maxCoeff();
    EXPECT_GT(at_half, 0.4 * max);
    EXPECT_LT(at_half, 0.8 * max);
}

/// A phase that a cord wrote beside the dimple of the cheek once drew a dark line from the corner of the mouth outwards.
TEST(PlatysmaCords, LeaveThePhasesOfOtherLinesAlone) {
    const rig::Head& head = rig::adult_placed();
    const WrinkleLines before = lay_wrinkle_lines(head, rig::adult().rig, head.skin);
    WrinkleLines lines = before;
    PlatysmaCords(head, rig::adult().rig).mark(lines);
    long checked = 0;
    for (long f = 0; f < head.skin.rows(); ++f)
        for (int slot = 0; slot < kWrinkleSlots; ++slot) {
            double shown = 0;
            for (int k = 0; k < 3; ++k)
                shown = std::max(shown, lines.window(head.skin(f, k), slot));
            if (shown == 0) continue;
            ++checked;
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(lines.phase(head.skin(f, k), slot), before.phase(head.skin(f, k), slot));
        }
    EXPECT_GT(checked, 1000);
    EXPECT_GT((lines.phase - before.phase).cwiseAbs().maxCoeff(), 0.0) << "cords have phases";
}

TEST(PlatysmaCords, ShowAsLinesThatStandOutInTheFace) {
    Face face = adult_face();
    StepStats figures;
    const FacePose pose = equilibrium_pose(face, with_unit("AU21"), &figures, kNearRest);
    EXPECT_TRUE(figures.converged);
    const Vec3 hyoid = face.head().landmark("hyo");
    double highest = 0;
    for (long v = 0; v < pose.vertices.rows(); ++v)
        if (face.head().vertices(v, 1) < hyoid.y() + face.head().mm(5))
            highest = std::min(highest, pose.fold_depth.row(v).minCoeff());
    EXPECT_LT(1e3 * highest, -0.5) << "mm";
}

}  // namespace
}  // namespace risorius::face
