// SPDX-License-Identifier: MIT
// A jaw that its muscles move, with the tissue of the face on it. Ranges: see jaw_dynamics_test.cpp.
#include <gtest/gtest.h>

#include <map>

#include "face/adult_face.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"

namespace risorius::face {
namespace {

using track::Kinematic;

Face& chewing() {
    static Face one = [] {
        Face made = adult_face();
        made.drive_jaw_by(track::JawDrive::kMuscles);
        return made;
    }();
    return one;
}
FacePose pose_after(int steps, const track::Drive& drive, bool from_rest = true) {
    if (from_rest) chewing().start(always(neutral()));
    for (int i = 0; i < steps; ++i) chewing().step(always(drive));
    return chewing().pose();
}
track::Drive openers() {
    track::Drive drive = neutral();
    for (const char* muscle :
         {"pterygoid_lateral_inferior", "digastric_anterior", "digastric_posterior", "geniohyoid",
          "mylohyoid_anterior", "mylohyoid_posterior"})
        drive = with_muscle(muscle, 1.0, std::nullopt, drive);
    return drive;
}

TEST(JawInFace, RestStaysAtRest) {
    const FacePose pose = pose_after(5, neutral());
    EXPECT_LT((chewing().diagnostics().skin_nodes() - chewing().diagnostics().rest_skin_nodes())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6);
    EXPECT_LT(std::abs(pose.jaw.open_m), 1e-6);
    EXPECT_NEAR(pose.jaw_open, 0.0, 1e-9);
}

TEST(JawInFace, OpensByMostOfItsRangeAndClosesWhenLetGo) {
    const FacePose open = pose_after(40, openers());
    EXPECT_GT(open.jaw.open_m, 0.70 * 56e-3);
    EXPECT_LT(std::abs(open.jaw.side_m), 0.1e-3);
    EXPECT_EQ(chewing().diagnostics().inverted_tets(), 0);
    // Chin and lower lip go with the bone.
    const Points moved = moved_mm(chewing(), open);
    EXPECT_LT(at(moved, "pg").y(), -25);
    EXPECT_LT(at(moved, "stoi").y(), -20);
    EXPECT_GT(at(moved, "sn").y(), -2.5);
    EXPECT_NEAR(open.jaw_open, 1.0, 0.05);
    const FacePose shut = pose_after(75, neutral(), false);
    EXPECT_LT(std::abs(shut.jaw.open_m), 0.5e-3);
}

track::Drive closers() {
    track::Drive drive = neutral();
    for (const char* muscle : {"masseter_superficial", "masseter_deep", "temporalis_anterior",
                               "temporalis_middle", "temporalis_posterior", "pterygoid_medial"})
        drive = with_muscle(muscle, 1.0, std::nullopt, drive);
    return drive;
}

TEST(JawInFace, BitesWithTheForceOfIncisors) {
    // 150-400 N on a block, some of the closers being volume muscles
    pose_after(24, openers());
    chewing().set_bite_block(10e-3);
    const double force = pose_after(40, closers(), false).tooth_force_n;
    chewing().set_bite_block(0);
    EXPECT_GT(force, 150);
    EXPECT_LT(force, 400);
    RecordProperty("force_n", std::to_string(force));
}

TEST(JawInFace, TheTissueHoldsItBack) {
    // A few hundredths of activation open a bare jaw by 20 mm; skin and flesh leave less than half of that.
    track::Drive drive = openers();
    drive.excitation *= 0.05;
    const JawDynamics bare(rig::adult_placed(), rig::adult().rig);
    JawDynamics::State state;
    for (int i = 0; i < 40; ++i) bare.advance(1.0 / 60, drive.excitation, state);
    const double alone = bare.joint().place(state.q).open_m;
    const double held = pose_after(40, drive).jaw.open_m;
    EXPECT_GT(held, 3e-3);
    EXPECT_LT(held, 0.6 * alone);
}

TEST(JawInFace, ChannelsAskMusclesForAboutWhatTheyAskBonesFor) {
    for (const auto& [channel, value, open, slide, side] :
         {std::tuple{Kinematic::kJawOpen, 0.5, 20e-3, 2e-3, 0.0},
          {Kinematic::kJawForward, 1.0, -4e-3, 8.2e-3, 0.0},
          {Kinematic::kJawSide, 1.0, 4e-3, 4e-3, 8e-3},
          {Kinematic::kJawSide, -0.5, 1e-3, 1e-3, -3.2e-3}}) {
        const FacePose pose = pose_after(40, with_kinematic(channel, value));
        EXPECT_NEAR(pose.jaw.open_m, open, 3e-3);
        EXPECT_NEAR(pose.jaw.forward_m, slide, 2e-3);
        EXPECT_NEAR(pose.jaw.side_m, side, 1.5e-3);
    }
}

TEST(JawInFace, FewIterationsFindWhatManyFind) {
    // In the middle of a fast opening, at 0.5 m/s
    Face careful = adult_face(
        {.name = "careful", .iterations = 200, .min_iterations = 6, .tolerance_rms_m = 1e-7});
    careful.drive_jaw_by(track::JawDrive::kMuscles);
    track::Drive drive = openers();
    drive.excitation *= 0.3;
    careful.start(always(neutral()));
    for (int i = 0; i < 5; ++i) careful.step(always(drive));
    EXPECT_TRUE(careful.diagnostics().history().back().converged);
    EXPECT_GT(careful.pose().jaw.open_m, 5e-3);
    EXPECT_NEAR(pose_after(5, drive).jaw.open_m, careful.pose().jaw.open_m, 2e-3);
}

TEST(JawInFace, SameDriveGivesSameBytes) {
    const track::Drive drive = openers();
    const Points first = pose_after(8, drive).vertices;
    EXPECT_EQ(pose_after(8, drive).vertices, first);
}

TEST(JawInFace, ChannelsPlaceItAgainWhenToldTo) {
    // Last, because it leaves the face to the channels
    const track::Drive drive = with_kinematic(Kinematic::kJawOpen, 0.3);
    chewing().drive_jaw_by(track::JawDrive::kChannels);
    const FacePose placed = pose_after(2, drive);
    EXPECT_EQ(placed.jaw_open, 0.3);
    EXPECT_EQ(placed.tooth_force_n, 0.0);
    EXPECT_GT(placed.jaw.open_m, 5e-3);
    chewing().drive_jaw_by(track::JawDrive::kMuscles);
    EXPECT_LT(pose_after(2, drive).jaw.open_m, placed.jaw.open_m);  // muscles take their time
}

}  // namespace
}  // namespace risorius::face
