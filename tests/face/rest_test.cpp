// SPDX-License-Identifier: MIT
// A face nobody drives is the face that was imported, and stays so.
#include <gtest/gtest.h>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

TEST(Rest, IsTheImportedFace) {
    Face face = adult_face();
    face.start(always(neutral()));
    const FacePose pose = face.pose();
    EXPECT_LT((pose.vertices - face.head().vertices).cwiseAbs().maxCoeff(), 1e-9);
    for (const Mat3& eye : pose.eye_rotation) EXPECT_LT((eye - Mat3::Identity()).norm(), 1e-12);
    EXPECT_TRUE(pose.head.isApprox(Rigid::Identity()));
    EXPECT_EQ(face.diagnostics().inverted_tets(), 0);
}

TEST(Rest, LastsThroughASecondOfSteps) {
    Face face = adult_face();
    const DriveAt drive = always(neutral());
    face.start(drive);
    for (int i = 0; i < 60; ++i) face.step(drive);
    EXPECT_NEAR(face.time_s(), 1.0, 1e-12);
    EXPECT_LT((face.pose().vertices - face.head().vertices).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(face.diagnostics().kinetic_energy_j(), 1e-18);
}

// Rounding hides every decrease of the energy then: the search for one made a held pose twice as expensive as a moving one.
TEST(Rest, AndAHeldPoseAreTheCheapestSteps) {
    Face face = adult_face();
    const auto evaluations = [&](const DriveAt& drive, int steps) {
        double sum = 0;
        for (int step = 0; step < steps; ++step) sum += face.step(drive).evaluations;
        return sum / steps;
    };
    const track::Drive smile = with_unit("AU12");
    face.start(always(neutral()));
    EXPECT_LT(evaluations(always(neutral()), 5), 6);
    const double moving = evaluations(always(smile), 12);
    for (int step = 0; step < 90; ++step) face.step(always(smile));
    EXPECT_LT(evaluations(always(smile), 10), 1.2 * moving);
}

TEST(Rest, IsTheEquilibriumWithoutDrive) {
    Face face = adult_face();
    face.start(always(neutral()));
    const StepStats figures = face.solve_equilibrium(neutral().excitation, neutral());
    EXPECT_TRUE(figures.converged);
    EXPECT_LT((face.pose().vertices - face.head().vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Rest, IsFoundAgainAfterASmile) {
    Face face = adult_face();
    equilibrium_pose(face, with_unit("AU12"));
    face.solve_equilibrium(neutral().excitation, neutral());
    EXPECT_LT(1e3 * (face.pose().vertices - face.head().vertices).rowwise().norm().maxCoeff(), 0.3)
        << "mm left of a smile that is over";
}

TEST(Rest, AMovedHeadStartsInEquilibriumWithItsDrive) {
    // A script may begin with a smile: nothing moves when it starts.
    Face face = adult_face();
    const DriveAt smile = always(with_unit("AU12", 0.5));
    face.start(smile);
    const Points first = face.pose().vertices;
    EXPECT_GT((first - face.head().vertices).rowwise().norm().maxCoeff(), 2e-3);
    for (int i = 0; i < 30; ++i) face.step(smile);
    EXPECT_LT(1e3 * (face.pose().vertices - first).rowwise().norm().maxCoeff(), 0.3);
}

}  // namespace
}  // namespace risorius::face
