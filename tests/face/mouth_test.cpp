// SPDX-License-Identifier: MIT
// What a mouth must be able to do: seal, slide, roll in, push out, smile, and open without showing its lining.
#include <algorithm>
#include <cmath>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

Face& adult() {
    static Face face = adult_face();
    return face;
}

/// Of the line from the rim of a lip to the border of its red, seen from the subject's left, deg; > 0 turns the border up and back.
double turn_of_red_deg(const Points& from, const Points& to, const char* rim, const char* border) {
    const auto angle = [&](const Points& table) {
        const Vec3 red = at(table, border) - at(table, rim);
        return std::atan2(red.y(), red.z());
    };
    constexpr double kTurn = 2 * 3.14159265358979323846;
    return 360 / kTurn * std::remainder(angle(to) - angle(from), kTurn);
}

TEST(Mouth, LipsAndTeethHardlyPassThroughEachOther) {
    for (const char* unit : {"AU18", "AU24", "AU14", "AU28_lower"}) {
        StepStats figures;
        equilibrium_pose(adult(), with_unit(unit), &figures);
        EXPECT_LE(figures.lip_depth_m, 0.3e-3) << unit;
        EXPECT_LE(figures.bone_depth_m, 0.2e-3) << unit;
        RecordProperty(unit, std::to_string(1e3 * figures.lip_depth_m) + " " +
                                 std::to_string(1e3 * figures.bone_depth_m));
    }
}

// Steps have a softer contact than equilibria and learn how hard it has to press.
TEST(Mouth, PressedLipsDoNotSinkInAsTimePasses) {
    const DriveAt drive = [](double t) { return with_unit("AU24", std::min(1.0, t / 0.2)); };
    adult().start(drive);
    StepStats figures, early;
    for (int i = 0; i < 45; ++i) {
        figures = adult().step(drive);
        if (i == 14) early = figures;
    }
    EXPECT_LE(figures.lip_depth_m, 0.3e-3);
    EXPECT_LE(figures.bone_depth_m, 0.2e-3);
    EXPECT_LE(figures.bone_depth_m, early.bone_depth_m + 0.02e-3);
}

TEST(Mouth, MarginalFibresRollTheLipsInOverTheTeeth) {
    const Points& rest = adult().head().vertices;
    const FacePose lower = equilibrium_pose(adult(), with_unit("AU28_lower"));
    // Less than the upper one, which it may not pass through
    EXPECT_GT(turn_of_red_deg(rest, lower.vertices, "stoi", "li"), 1.5);
    EXPECT_LT(at(moved_mm(adult(), lower), "stoi").z(), -1.5);
    // It buckles on its way, and comes to rest late
    StepStats figures;
    const FacePose upper = equilibrium_pose(adult(), with_unit("AU28_upper"), &figures);
    EXPECT_TRUE(figures.converged);
    EXPECT_LE(figures.lip_depth_m, 0.3e-3);
    EXPECT_LT(turn_of_red_deg(rest, upper.vertices, "stos", "ls"), -6);
    EXPECT_LT(at(moved_mm(adult(), upper), "stos").z(), -1.5);
}

TEST(Mouth, PeripheralFibresPushTheLipsForwards) {
    const Points moved = moved_mm(adult(), equilibrium_pose(adult(), with_unit("AU18")));
    // The rims turn out, so that they come farther forward than the borders of the red
    for (const char* rim : {"stos", "stoi"}) EXPECT_GT(at(moved, rim).z(), 8) << rim;
    for (const char* border : {"ls", "li"}) EXPECT_GT(at(moved, border).z(), 2.5) << border;
    EXPECT_LT(at(moved, "ch_l").x(), -2);
    EXPECT_GT(at(moved, "ch_r").x(), 2);
}

TEST(Mouth, ASmileDrawsTheCornersUpWithoutTheLipsOverlapping) {
    StepStats figures;
    const Points moved = moved_mm(adult(), equilibrium_pose(adult(), with_unit("AU12"), &figures));
    EXPECT_LE(figures.lip_depth_m, 0.3e-3);
    EXPECT_LE(figures.bone_depth_m, 0.2e-3);
    for (const char* corner : {"ch_l", "ch_r"}) {
        EXPECT_GT(at(moved, corner).norm(), 9) << corner;
        EXPECT_LT(at(moved, corner).norm(), 17) << corner;
        EXPECT_GT(at(moved, corner).y(), 6) << corner;
    }
}

TEST(Mouth, AWideOpenJawLeavesTheUpperLipAndItsLiningAtTheTeeth) {
    const FacePose pose = equilibrium_pose(adult(), with_kinematic(track::Kinematic::kJawOpen, 1));
    const rig::Head& head = adult().head();
    const Points moved = moved_mm(adult(), pose);
    EXPECT_GT(at(moved, "stos").y(), -7);
    EXPECT_LT(at(moved, "stoi").y(), -24);
    // Lining that lies behind the upper lip stays there
    double lowest = 0;
    for (long f = 0; f < head.lining.rows(); ++f) {
        const int v = head.lining(f, 0);
        const Vec3 p = head.vertices.row(v).transpose();
        if (p.z() < head.landmark("sto").z() - head.mm(14) || std::abs(p.x()) > head.mm(12) ||
            p.y() < head.landmark("stos").y() + head.mm(1))
            continue;
        lowest = std::min(lowest, moved(v, 1));
    }
    EXPECT_LT(lowest, 0);
    EXPECT_GT(lowest, -9);
}

}  // namespace
}  // namespace risorius::face
