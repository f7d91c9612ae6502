// SPDX-License-Identifier: MIT
// Frames between two steps: the curve is exact for a constant velocity, close to the parabola, and has no corners at steps.
#include "risorius/face/solver/detail/between_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

Face coarse_face() {
    return adult_face({.name = "coarse", .shell_vertices = 300, .iterations = 30});
}

double between(double fraction, const auto& x) {
    return smooth(fraction).of(x(-1.0), x(0.0), x(1.0));
}

TEST(BetweenSteps, MeetTheStepsAndKeepAConstantVelocity) {
    EXPECT_EQ(smooth(1).of(5.0, 7.0, 0.1), 0.1) << "to the bit";
    EXPECT_EQ(smooth(0).of(5.0, 0.3, 9.0), 0.3);
    for (double f = 0; f <= 1; f += 0.05)
        EXPECT_NEAR(between(f, [](double t) { return 3 - 2 * t; }), 3 - 2 * f, 1e-14);
}

TEST(BetweenSteps, AreCloseToAParabola) {
    double worst = 0, worst_straight = 0;
    const auto parabola = [](double t) { return t * t / 2; };
    for (double f = 0; f <= 1; f += 0.001) {
        worst = std::max(worst, std::abs(between(f, parabola) - parabola(f)));
        worst_straight =
            std::max(worst_straight, std::abs(straight(f).of(0.5, 0.0, 0.5) - parabola(f)));
    }
    EXPECT_NEAR(worst, 0.0481, 1e-4);
    EXPECT_NEAR(worst_straight, 0.125, 1e-4) << "what a straight line errs";
    EXPECT_NEAR(between(0.5, parabola), 0.125, 1e-15) << "exact in the middle";
}

TEST(BetweenSteps, HaveTheSameVelocityOnBothSidesOfAStep) {
    const auto x = [](double t) { return std::sin(0.7 * t) + 0.2 * t * t; };
    const double d = 1e-6;
    for (double step = 0; step < 5; ++step) {
        const auto here = [&](double t) { return x(step + t); };
        const auto next = [&](double t) { return x(step + 1 + t); };
        const double left = (between(1, here) - between(1 - d, here)) / d,
                     right = (between(d, next) - between(0, next)) / d;
        EXPECT_NEAR(left, right, 1e-5) << step;
        const double straight_left = x(step + 1) - x(step),
                     straight_right = x(step + 2) - x(step + 1);
        EXPECT_GT(std::abs(straight_left - straight_right), 1e-3) << "a straight line has a corner";
    }
}

/// x of the vertex of the skin that is nearest to the left corner of the mouth at rest, m.
double corner_of_mouth(const Face& face, const FacePose& pose) {
    long nearest = 0;
    (face.head().vertices.rowwise() - face.head().landmark("ch_l").transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    return pose.vertices(nearest, 0);
}

// A smile at 240 frames/s. On straight lines, 3 of 4 second differences are 0, and the fourth has all of the change.
TEST(BetweenSteps, LetAFaceMoveWithoutCorners) {
    Face face = coarse_face();
    const DriveAt drive = [](double t) {
        return with_unit("AU12", 0.5 - 0.5 * std::cos(std::min(t, 0.4) / 0.4 * M_PI));
    };
    face.start(drive);
    std::vector<double> x;
    for (int i = 0; i < 96; ++i) x.push_back(corner_of_mouth(face, face.pose_at(i / 240.0, drive)));
    double at_steps = 0, elsewhere = 0;
    for (std::size_t i = 12; i + 1 < x.size(); ++i)
        (i % 4 == 0 ? at_steps : elsewhere) += std::abs(x[i + 1] - 2 * x[i] + x[i - 1]);
    EXPECT_LT(at_steps, 0.5 * (at_steps + elsewhere)) << "a quarter of all frames";
    EXPECT_GT(elsewhere, 0);
}

TEST(BetweenSteps, AreStraightAfterAJumpOfTheDrive) {
    Face face = coarse_face();
    const DriveAt drive = [](double t) {
        return with_kinematic(track::Kinematic::kJawOpen, t < 0.05 ? 0.0 : 0.5);
    };
    face.start(drive);
    double opening = 0;
    for (int i = 1; i < 60; ++i) {
        const double now = face.pose_at(i / 240.0, drive).jaw_open;
        EXPECT_GE(now, opening - 1e-9) << "overshoots at " << i;
        opening = now;
    }
    EXPECT_NEAR(opening, 0.5, 1e-6);
}

}  // namespace
}  // namespace risorius::face
