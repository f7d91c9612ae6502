// SPDX-License-Identifier: MIT
// In motion the face stays bounded, comes to rest, and is the same every time and at every frame rate.
#include <gtest/gtest.h>

#include <random>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

using track::Kinematic;

/// A third of the muscles at random every fifth of a second, and a talking jaw.
DriveAt random_drive(unsigned seed, double until_s) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<track::Drive> drives;
    for (double t = 0; t < until_s; t += 0.2) {
        track::Drive drive = neutral();
        for (long c = 0; c < drive.excitation.size(); ++c)
            if (uniform(random) < 0.35) drive.excitation[c] = uniform(random);
        drive = with_kinematic(Kinematic::kGazeYawLeft, 40 * uniform(random) - 20, drive);
        drives.push_back(drive);
    }
    return [drives](double t) {
        const std::size_t at = std::min(drives.size() - 1, static_cast<std::size_t>(t / 0.2));
        const double open = 0.3 - 0.3 * std::cos(4 * 3.14159265358979323846 * t);
        return with_kinematic(Kinematic::kJawOpen, open, drives[at]);
    };
}

DriveAt talking() {
    return [](double t) {
        track::Drive drive = with_unit("AU12", 0.5 - 0.5 * std::cos(6 * t));
        drive = with_kinematic(Kinematic::kJawOpen, 0.25 - 0.25 * std::cos(20 * t), drive);
        drive = with_kinematic(Kinematic::kHeadYaw, 10 * std::sin(3 * t), drive);
        return with_kinematic(Kinematic::kGazeYawLeft, 10 * std::sin(5 * t), drive);
    };
}

/// Built once for the tests that start it anew.
Face& moving_face() {
    static Face one = adult_face();
    return one;
}

TEST(Motion, FiveSecondsOfRandomDriveStayBounded) {
    Face& face = moving_face();
    const DriveAt drive = random_drive(2024, 5);
    face.start(drive);
    Points before = face.pose().vertices;
    double fastest = 0, furthest = 0;
    int inverted = 0;
    for (int i = 0; i < 300; ++i) {
        face.step(drive);
        const Points now = face.pose().vertices;
        ASSERT_TRUE(now.allFinite()) << "at step " << i;
        fastest = std::max(fastest, (now - before).rowwise().norm().maxCoeff() / kStep_s);
        furthest = std::max(furthest, (now - face.head().vertices).rowwise().norm().maxCoeff());
        inverted = std::max(inverted, face.diagnostics().inverted_tets());
        before = now;
    }
    EXPECT_LT(fastest, 2.5) << "m/s";
    EXPECT_LT(furthest, 0.05) << "m";
    EXPECT_LT(inverted, face.diagnostics().tet_count() / 20);
    RecordProperty("fastest_m_per_s", std::to_string(fastest));
    RecordProperty("furthest_mm", std::to_string(1e3 * furthest));
    RecordProperty("inverted", inverted);
}

TEST(Motion, HeldStillTheFaceComesToRest) {
    Face& face = moving_face();
    const DriveAt wild = random_drive(7, 1);
    const track::Drive last = wild(0.999);
    const DriveAt drive = [&](double t) { return t < 1 ? wild(t) : last; };
    face.start(always(neutral()));
    double max = 0;
    for (int i = 0; i < 60; ++i) {
        face.step(drive);
        max = std::max(max, face.diagnostics().kinetic_energy_j());
    }
    for (int i = 0; i < 120; ++i) face.step(drive);
    // What is left is a tremor of lips in contact, some hundredths of a millimetre a step.
    EXPECT_LT(face.diagnostics().kinetic_energy_j(), 1e-3 * max);
    const Points before = face.pose().vertices;
    face.step(drive);
    const double speed = (face.pose().vertices - before).rowwise().norm().maxCoeff() / kStep_s;
    EXPECT_LT(speed, 15e-3) << "m/s";
    RecordProperty("ratio", std::to_string(max / face.diagnostics().kinetic_energy_j()));
    RecordProperty("speed_mm_per_s", std::to_string(1e3 * speed));
}

// Contact planes taken from the nearest bone point alone jumped from step to step and kept lips moving at 6 mm/s.
TEST(Motion, AHeldExpressionDoesNotTremble) {
    const auto held = [](const char* unit, Face& face, const char* quality) {
        const DriveAt drive = [&](double t) { return with_unit(unit, std::min(1.0, t / 0.3)); };
        face.start(drive);
        for (int i = 0; i < 100; ++i) face.step(drive);
        const Points before = face.diagnostics().skin_nodes();
        face.step(drive);
        const double fastest =
            (face.diagnostics().skin_nodes() - before).rowwise().norm().maxCoeff() / kStep_s;
        EXPECT_LT(fastest, 0.2e-3) << unit << " in " << quality << ", m/s";
    };
    for (const char* unit : {"AU12", "AU17", "AU27"}) held(unit, moving_face(), "preview");
    Face finer = adult_face(quality_named("video"));
    held("AU17", finer, "video");
}

TEST(Motion, StepsComeToTheEquilibriumThatSettlingFinds) {
    Face& stepped = moving_face();
    const track::Drive smile = with_unit("AU12", 0.6);
    const DriveAt drive = [&](double) { return smile; };
    stepped.start(always(neutral()));
    for (int i = 0; i < 120; ++i) stepped.step(drive);
    const Points a = stepped.pose().vertices, b = equilibrium_pose(stepped, smile).vertices;
    EXPECT_LT(1e3 * (a - b).rowwise().norm().maxCoeff(), 0.5);
}

TEST(Motion, TheSameDrivesGiveTheSameBits) {
    Face a = adult_face(), b = adult_face();
    const DriveAt drive = random_drive(3, 1);
    a.start(drive);
    b.start(drive);
    for (int i = 0; i < 60; ++i) {
        a.step(drive);
        b.step(drive);
    }
    EXPECT_TRUE((a.pose().vertices.array() == b.pose().vertices.array()).all());
    EXPECT_EQ(a.diagnostics().kinetic_energy_j(), b.diagnostics().kinetic_energy_j());
}

TEST(Motion, AFaceStartedAgainForgetsWhatItDid) {
    Face face = adult_face();  // none that did anything before
    const DriveAt drive = talking();
    const auto run = [&] {
        face.start(drive);
        return face.pose_at(0.5, drive).vertices;
    };
    const Points first = run();
    equilibrium_pose(face, with_unit("AU27"), nullptr, kNearRest);
    const Points second = run();
    EXPECT_TRUE((first.array() == second.array()).all());
    EXPECT_EQ(face.diagnostics().history().size(), 30u);
}

TEST(Motion, EveryFrameRateShowsTheSameMoments) {
    Face& face = moving_face();
    const DriveAt drive = talking();
    const auto frames = [&](int fps) {
        std::vector<Points> out;
        face.start(drive);
        for (int i = 0; i <= fps / 4; ++i)
            out.push_back(face.pose_at(static_cast<double>(i) / fps, drive).vertices);
        return out;
    };
    const std::vector<Points> finest = frames(600);
    EXPECT_GT((finest[150] - finest[50]).cwiseAbs().maxCoeff(), 1e-3);
    for (int fps : {24, 25, 30, 50, 60, 120}) {
        const std::vector<Points> shown = frames(fps);
        for (std::size_t i = 0; i < shown.size(); ++i)
            ASSERT_TRUE((shown[i].array() == finest[i * (600 / fps)].array()).all())
                << fps << " fps, frame " << i;
    }
}

TEST(Motion, BetweenStepsTheFaceIsBetween) {
    Face& face = moving_face();
    const DriveAt drive = talking();
    face.start(drive);
    const Vec3 a = at(face.pose_at(12 * kStep_s, drive).vertices, "ch_l"),
               middle = at(face.pose_at(12.5 * kStep_s, drive).vertices, "ch_l"),
               b = at(face.pose_at(13 * kStep_s, drive).vertices, "ch_l");
    EXPECT_LT((middle - 0.5 * (a + b)).norm(), 0.05 * (b - a).norm() + 1e-9);
    EXPECT_GT((b - a).norm(), 1e-5);
}

TEST(Motion, VideoQualityConvergesEachStep) {
    Face face = adult_face(quality_named("video"));
    const DriveAt drive = talking();
    face.start(drive);
    int unfinished = 0;
    for (int i = 0; i < 30; ++i) unfinished += !face.step(drive).converged;
    EXPECT_LE(unfinished, 1);
    EXPECT_THROW(quality_named("best"), Error);
}

// A step ends when its iterations no longer move the nodes, so those in which much changes get more of them. Twelve for each
// left 0.8 mm RMS in this smile's first steps.
TEST(Motion, StepsOfAPreviewFollowConvergedStepsThroughAJump) {
    constexpr int kSteps = 12;
    const DriveAt drive = [](double t) {
        return t > 2.5 * kStep_s ? with_unit("AU12") : neutral();
    };
    const auto played = [&](const Quality& quality) {
        Face face = adult_face(quality);
        face.start(drive);
        std::vector<Points> skin;
        std::vector<int> iterations;
        for (int i = 0; i < kSteps; ++i) {
            iterations.push_back(face.step(drive).iterations);
            skin.push_back(face.diagnostics().skin_nodes());
        }
        return std::pair(skin, iterations);
    };
    Quality exact = preview();
    exact.iterations = 800;
    exact.tolerance_rms_m = 2e-8;
    exact.precision = solve::Precision::kDouble;
    const auto [converged, unused] = played(exact);
    const auto [skin, iterations] = played(preview());
    double largest_mm = 0;
    for (std::size_t i = 0; i < skin.size(); ++i) {
        const Points off = 1e3 * (skin[i] - converged[i]);
        largest_mm =
            std::max(largest_mm, std::sqrt(off.squaredNorm() / static_cast<double>(off.rows())));
    }
    EXPECT_LT(largest_mm, 0.15);
    EXPECT_LE(iterations.front(), 6) << "at rest";
    EXPECT_GT(*std::max_element(iterations.begin(), iterations.end()), 20);
}

}  // namespace
}  // namespace risorius::face
