// SPDX-License-Identifier: MIT
// What tissue feels of weight and of a moving head, and that it does not matter in which steps it is computed.
#include <gtest/gtest.h>

#include "face/adult_face.h"
#include "risorius/face/solver/detail/tissue_motion.h"
#include "risorius/face/solver/stress.h"

namespace risorius::face {
namespace {

using track::Kinematic;

constexpr double kG = 9.81;

Face small_face(double step_s = kStep_s, double substep_s = kStep_s) {
    return adult_face({.name = "small",
                       .shell_vertices = 300,
                       .iterations = 60,
                       .min_iterations = 4,
                       .tolerance_rms_m = 0.2e-6,
                       .step_s = step_s,
                       .max_substep_s = substep_s});
}

/// The same for tests that start it anew, upright and dynamic.
Face& shared_face() {
    static Face face = small_face();
    face.set_gravity(Vec3(0, -kG, 0));
    face.move(Motion::kDynamic);
    face.drive_jaw_by(track::JawDrive::kChannels);
    return face;
}

double furthest_mm(const Points& a, const Points& b) {
    return 1e3 * (a - b).rowwise().norm().maxCoeff();
}

TEST(Dynamics, UprightWeightLeavesTheImportedFaceAsItIs) {
    Face& face = shared_face();
    for (const std::optional<Vec3>& gravity :
         {std::optional<Vec3>(Vec3(0, -kG, 0)), std::optional<Vec3>()}) {
        face.set_gravity(gravity);
        face.start(always(neutral()));
        for (int i = 0; i < 10; ++i) face.step(always(neutral()));
        EXPECT_LT((face.pose().vertices - face.head().vertices).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(Dynamics, LyingOnTheBackCheeksSinkTowardsTheEars) {
    Face& face = shared_face();
    face.set_gravity(Vec3(0, 0, -kG));
    const Points lying = moved_mm(face, equilibrium_pose(face, neutral()));
    for (const char* cheek : {"mc_l", "mc_r"}) {
        EXPECT_LT(at(lying, cheek).z(), -0.2) << cheek << ", mm";
        EXPECT_GT(at(lying, cheek).y(), 0.3) << "what hung upright hangs no more";
        EXPECT_LT(at(lying, cheek).norm(), 6) << "mm";
    }
    EXPECT_GT(at(lying, "mc_l").x(), 0);
    EXPECT_LT(at(lying, "mc_r").x(), 0);
}

TEST(Dynamics, ATiltedHeadHangsAsOneUnderTiltedWeight) {
    Face& face = shared_face();
    const FacePose tilted = equilibrium_pose(face, with_kinematic(Kinematic::kHeadRoll, 40));
    const Points nodes = face.diagnostics().skin_nodes();
    face.set_gravity(Vec3(tilted.head.linear().transpose() * Vec3(0, -kG, 0)));
    equilibrium_pose(face, neutral());
    EXPECT_LT(furthest_mm(nodes, face.diagnostics().skin_nodes()), 1e-3);
    EXPECT_GT(furthest_mm(nodes, face.diagnostics().rest_skin_nodes()), 0.3);
}

// D'Alembert: a head that gains speed evenly feels a weight the other way.
TEST(Dynamics, SteadyAccelerationIsATiltedWeight) {
    const double a = 4.0;  // m/s^2, forwards
    Face moving = small_face();
    Face& still = shared_face();
    const DriveAt rush = [&](double t) {
        return with_kinematic(Kinematic::kHeadForward,
                              1e3 * 0.5 * a * t * t / moving.head().size - 60);
    };
    moving.start(rush);
    for (int i = 0; i < 15; ++i) moving.step(rush);
    still.set_gravity(Vec3(0, -kG, -a));
    still.start(always(neutral()));
    // Still swinging a little about that shape
    EXPECT_LT(furthest_mm(moving.diagnostics().skin_nodes(), still.diagnostics().skin_nodes()),
              0.35 * furthest_mm(still.diagnostics().skin_nodes(),
                                 still.diagnostics().rest_skin_nodes()));
    EXPECT_GT(furthest_mm(still.diagnostics().skin_nodes(), still.diagnostics().rest_skin_nodes()),
              0.3);
}

// Nodes on which nothing acts stay where they are in space, however the head turns: no force has been invented.
TEST(Dynamics, FreeNodesGoStraightThroughSpaceWhileTheHeadTurns) {
    const rig::Head head = rig::place_head(rig::adult().rig, rig::adult().mesh, "adult");
    const Neck neck(head);
    Points nodes(2, 3);
    nodes << 0.03, -0.02, 0.08, -0.05, 0.04, 0.02;
    const double h = 1.0 / 120;
    TissueMotion motion(neck, nodes, h);
    motion.start(nodes, Rigid::Identity());
    for (int i = 1; i <= 60; ++i) {
        track::Drive drive = with_kinematic(Kinematic::kHeadYaw, 20 * std::sin(5 * h * i) * h * i);
        drive = with_kinematic(Kinematic::kHeadUp, 10 * (1 - std::cos(6 * h * i)), drive);
        const Rigid place = head_motion(head, drive);
        const Points aim = motion.begin(place).aim;
        motion.end(aim);
        for (long n = 0; n < nodes.rows(); ++n)
            ASSERT_LT((place * Vec3(aim.row(n).transpose()) - nodes.row(n).transpose()).norm(),
                      1e-12);
    }
}

TEST(Dynamics, AHeadThatJumpsIsFeltNoHarderThanTenTimesItsWeight) {
    const rig::Head head = rig::place_head(rig::adult().rig, rig::adult().mesh, "adult");
    const Neck neck(head);
    Points node(1, 3);
    node << 0, 0, 0.1;
    TissueMotion motion(neck, node, kStep_s);
    motion.start(node, Rigid::Identity());
    const Rigid away = head_motion(head, with_kinematic(Kinematic::kHeadYaw, 60));
    const double lag = (motion.begin(away).aim - node).norm();
    EXPECT_LE(lag, 1.2 * kMaxFelt_m_s2 * kStep_s * kStep_s);
    EXPECT_GT(lag, 0.1 * kMaxFelt_m_s2 * kStep_s * kStep_s);
}

/// A footfall: the head is stopped within 60 ms from the fall before, a quarter of a second in.
DriveAt footfall(double g) {
    return [g](double t) {
        constexpr double kPi = 3.14159265358979323846, kContact_s = 0.06;
        const double a = g * kG, fall = -2 * a * kContact_s / kPi,
                     s = std::min(t - 0.25, kContact_s);
        double y = fall * s;
        if (s > 0)
            y += a * kContact_s / kPi * (s - kContact_s / kPi * std::sin(kPi * s / kContact_s));
        return with_kinematic(Kinematic::kHeadUp, 1e3 * y);
    };
}

TEST(Dynamics, ACheekSwingsAfterAFootfallAndComesToRest) {
    Face face = small_face(1.0 / 120, 1.0 / 120);
    const DriveAt drive = footfall(2.5);
    face.start(drive);
    double lowest = 0, highest_after = 0, left = 0;
    double before = 0, crossing_s = -1, last_crossing_s = -1;
    int crossings = 0;
    for (int i = 0; i < 96; ++i) {
        face.step(drive);
        if (face.time_s() < 0.25) continue;
        const double y = at(moved_mm(face, face.pose()), "mc_l").y() -
                         1e3 * (face.pose().head * Vec3::Zero()).y();
        if (y < lowest) {
            lowest = y;
            highest_after = y;
        }
        highest_after = std::max(highest_after, y);
        if (face.time_s() > 0.315 && before * y < 0) {
            if (crossing_s < 0) crossing_s = face.time_s();
            last_crossing_s = face.time_s();
            ++crossings;
        }
        before = y;
        if (face.time_s() > 0.7) left = std::max(left, std::abs(y));
    }
    EXPECT_LT(lowest, -1.5) << "mm";
    EXPECT_GT(lowest, -9) << "mm";
    EXPECT_GT(highest_after, 0.1 * -lowest) << "it swings back";
    EXPECT_LT(left, 0.1 * -lowest) << "half a second later";
    ASSERT_GE(crossings, 2);
    const double hz = 0.5 * (crossings - 1) / (last_crossing_s - crossing_s);
    EXPECT_GT(hz, 4);
    EXPECT_LT(hz, 14);
    RecordProperty("lowest_mm", std::to_string(lowest));
    RecordProperty("hz", std::to_string(hz));
}

TEST(Dynamics, LongAndShortStepsShowTheSameMoments) {
    const DriveAt drive = [](double t) {
        track::Drive d = with_unit("AU12", 0.4 - 0.4 * std::cos(8 * t));
        d = with_kinematic(Kinematic::kJawOpen, 0.15 - 0.15 * std::cos(10 * t), d);
        d = with_kinematic(Kinematic::kHeadPitch, -4 + 4 * std::cos(9 * t), d);
        return with_kinematic(Kinematic::kHeadYaw, 10 * std::sin(6 * t), d);
    };
    std::vector<std::vector<Points>> shown;
    // Steps of 1/30, 1/60 and 1/120 s as "video" solves them, then pieces of half that length
    for (const auto& [hz, piece_hz] : {std::pair{30, 120}, {60, 120}, {120, 120}, {60, 240}}) {
        Face face = small_face(1.0 / hz, 1.0 / piece_hz);
        face.start(drive);
        shown.emplace_back();
        for (int i = 1; i <= 12; ++i) {
            face.pose_at(i / 30.0, drive);
            shown.back().push_back(face.diagnostics().skin_nodes());
        }
    }
    for (std::size_t other = 1; other < shown.size(); ++other)
        for (std::size_t i = 0; i < shown[0].size(); ++i)
            EXPECT_LT(furthest_mm(shown[0][i], shown[other][i]), other < 3 ? 0.3 : 0.6)
                << other << " at " << i;
}

TEST(Dynamics, AQuasiStaticFaceIsWhereItsDriveHoldsIt) {
    Face moving = small_face();
    Face& held = shared_face();
    const DriveAt drive = [](double t) { return with_unit("AU12", t < 0.1 ? 0.0 : 0.7); };
    moving.move(Motion::kQuasiStatic);
    moving.start(drive);
    EXPECT_LT(furthest_mm(moving.pose_at(0.05, drive).vertices, moving.head().vertices), 1e-6);
    const FacePose pose = moving.pose_at(0.1, drive);
    // Skin over the soft fold of the cheek creeps last
    EXPECT_LT(furthest_mm(pose.vertices, equilibrium_pose(held, with_unit("AU12", 0.7)).vertices),
              0.3);
    const int zygomaticus = channels().column("zygomaticus_major", Side::kLeft);
    EXPECT_EQ(moving.activation_at(0.1)[zygomaticus],
              with_unit("AU12", 0.7).excitation[zygomaticus]);
}

TEST(Dynamics, AJawMovedByMusclesFeelsWhichWayIsDown) {
    Face& face = shared_face();
    face.drive_jaw_by(track::JawDrive::kMuscles);
    const auto open_mm = [&](const Vec3& gravity) {
        face.set_gravity(gravity);
        // A little open, so that weight and not the teeth decides
        equilibrium_pose(face, with_kinematic(Kinematic::kJawOpen, 0.2));
        return 1e3 * face.pose().jaw.open_m;
    };
    EXPECT_GT(open_mm({0, -3 * kG, 0}), open_mm({0, 3 * kG, 0}) + 0.05);
}

TEST(Dynamics, AFaceOfUsualSizeSettlesToWhereItBegan) {
    Face face = adult_face(quality_named("preview"));
    const StressReport report = stress(face, channels(), {.steps = 40, .rest_steps = 150});
    EXPECT_EQ(report.broken_steps, 0);
    EXPECT_EQ(report.inverted_at_rest, 0);
    EXPECT_GT(report.furthest_m, 0.005);
    EXPECT_LT(1e3 * report.residual_displacement_m, 0.05);
}

TEST(Dynamics, RandomDriveOfEverythingLeavesNothingBehind) {
    Face face =
        adult_face({.name = "small", .shell_vertices = 300, .iterations = 6, .min_iterations = 6});
    const StressReport report =
        stress(face, channels(), {.steps = 200, .seed = 4, .rest_steps = 150});
    EXPECT_EQ(report.steps, 200);
    EXPECT_EQ(report.broken_steps, 0);
    EXPECT_EQ(report.inverted_at_rest, 0);
    EXPECT_LT(1e3 * report.residual_displacement_m, 0.2);
    EXPECT_LT(report.furthest_m, 0.06);
    EXPECT_LT(1e3 * report.deepest_penetration.lips_m, 0.3);
    EXPECT_LT(1e3 * report.deepest_penetration.bone_m, 0.2);
    EXPECT_LT(1e3 * report.deepest_penetration.eyeball_m, 0.2);
    RecordProperty("most_inverted", report.max_inverted_tets);
    RecordProperty("left_mm", std::to_string(1e3 * report.residual_displacement_m));
}

}  // namespace
}  // namespace risorius::face
