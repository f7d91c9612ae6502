// SPDX-License-Identifier: MIT
// The mouth's own iterations are iterations of the same step.
#include "risorius/face/solver/detail/local_solve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

Quality with_mouth(int iterations, int mouth_passes, double tolerance_rms_m) {
    return {.name = "small",
            .shell_vertices = 300,
            .iterations = iterations,
            .mouth_passes = mouth_passes,
            .tolerance_rms_m = tolerance_rms_m,
            .precision = solve::Precision::kDouble};
}

// Lips that press on each other and on teeth, muscles, skin, an open jaw, air behind it and the weight of a tilted head: all that
// pulls at a mouth.
track::Drive all_that_pulls(double t_s) {
    const double fraction = std::min(1.0, t_s / 0.1);
    track::Drive drive = with_kinematic(track::Kinematic::kJawOpen, 0.3 * fraction);
    drive.excitation +=
        fraction * (with_unit("AU18").excitation + 0.5 * with_unit("AU12").excitation);
    drive.kinematic[static_cast<std::size_t>(track::Kinematic::kMouthPressure)] = 300;
    drive.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadPitch)] = 20 * fraction;
    return drive;
}

Face played(const Quality& quality, int steps) {
    Face face = adult_face(quality);
    face.start(always(neutral()));
    for (int i = 0; i < steps; ++i) face.step(all_that_pulls);
    return face;
}

TEST(LocalSolve, AStepThatHasConvergedStaysWhereItIs) {
    constexpr int kSteps = 4;
    const Points whole = played(with_mouth(1000, 0, 1e-9), kSteps).statics().nodes();
    const Points both = played(with_mouth(1000, 30, 1e-9), kSteps).statics().nodes();
    // What iterations of less than 0.001 micrometres RMS leave at the softest nodes
    EXPECT_LT((both - whole).rowwise().norm().maxCoeff(), 5e-6);
}

TEST(LocalSolve, TheMouthsOwnIterationsBringItNearerToTheConvergedStep) {
    constexpr int kSteps = 24;
    const auto skin = [](const Quality& quality) {
        return played(quality, kSteps).diagnostics().skin_nodes();
    };
    const Points converged = skin(with_mouth(1000, 0, 1e-9));
    // Once it has come: on the way single nodes of lips snap over each other a step sooner or later.
    const auto off = [&](int mouth_passes) {
        return (skin(with_mouth(6, mouth_passes, 0)) - converged).norm();
    };
    EXPECT_LT(off(10), 0.7 * off(0));
}

}  // namespace
}  // namespace risorius::face
