// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/rig_voice.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/face/quality.h"
#include "risorius/face/surfaces.h"
#include "risorius/scene/rig_files.h"
#include "risorius/speech/trajectory.h"
#include "risorius/talk/detail/check_speech.h"
#include "risorius/talk/detail/speech_drive.h"
#include "risorius/talk/say_event.h"
#include "risorius/talk/speak_script.h"

namespace risorius::talk {
namespace {

const std::vector<std::string> kColumns{"opener", "rounder", "presser"};

/// Poses of a mouth that is linear: the opener opens by 10 mm, the rounder pushes out by 6 mm, the presser presses.
RigVoice linear_voice() {
    std::vector<MouthPose> poses;
    for (const double jaw : {0.0, 5.0, 10.0})
        for (const double open : {0.0, 0.5, 1.0})
            for (const double round : {0.0, 1.0})
                for (const double press : {0.0, 1.0}) {
                    MouthPose pose;
                    pose.activation = Eigen::Vector3d(open, round, press);
                    pose.jaw_open = jaw / 40;
                    pose.mouth.jaw = jaw;
                    pose.virtual_gap = kGapOfJaw * jaw + 10 * open - 8 * press;
                    pose.mouth.gap = std::max(0.0, pose.virtual_gap);
                    pose.mouth.width = -8 * round;
                    pose.mouth.upper_protrusion = pose.mouth.lower_protrusion = 6 * round;
                    poses.push_back(pose);
                }
    return {poses, {0, 2, 4, 6, 8, 10, 12}, kColumns};
}

TEST(RigVoice, MixesPosesToTheWantedMouth) {
    const RigVoice voice = linear_voice();
    Eigen::VectorXd state;
    const Eigen::VectorXd round = voice.activation_for(
        {.jaw = 5, .gap = 5, .width = -4, .protrusion = 3, .labiodental = 0, .bounded = 0}, state);
    EXPECT_NEAR(round[1], 0.5, 0.1);
    EXPECT_NEAR(10 * round[0] - 8 * round[2] + kGapOfJaw * 5, 5, 0.6);
    const Eigen::VectorXd closed = voice.activation_for(
        {.jaw = 4, .gap = -1.2, .width = 0, .protrusion = 0, .labiodental = 0, .bounded = 1},
        state);
    EXPECT_LT(10 * closed[0] - 8 * closed[2] + kGapOfJaw * 4, -0.5);
    EXPECT_LT(closed[1], 0.15);
    EXPECT_DOUBLE_EQ(voice.jaw_open_of(3), 0.075);
}

TEST(RigVoice, ChangesLittleWhenTheWantedMouthDoes) {
    const RigVoice voice = linear_voice();
    Eigen::VectorXd state, before;
    for (double gap = -1.5; gap < 8; gap += 0.01) {
        const Eigen::VectorXd now = voice.activation_for(
            {.jaw = 4, .gap = gap, .width = -2, .protrusion = 2, .labiodental = 0, .bounded = 0},
            state);
        if (before.size() > 0) {
            EXPECT_LT((now - before).cwiseAbs().maxCoeff(), 0.05) << gap;
        }
        before = now;
    }
}

TEST(RigVoice, IsWrittenAndReadAgain) {
    const RigVoice voice = linear_voice();
    const RigVoice again = RigVoice::read(JsonCursor::from_json(voice.json("x"), "v"), kColumns);
    EXPECT_EQ(again.json("x"), voice.json("x"));
    EXPECT_EQ(
        message_of([&] { RigVoice::read(JsonCursor::from_json(voice.json("x"), "v"), {"other"}); }),
        "v:/columns: expected the muscles of the rig, found others");
}

TEST(MouthMeasures, ATouchingMouthHasNoGapAndAnOpenJawOpensIt) {
    const scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    face::Face face(files.rig, files.mesh, face::quality_named("draft"), "adult");
    const MouthMeasures measures(face.head(), files.rig);
    track::Drive drive;
    const Mouth rest = measures.at(face.surfaces().posed(face.head().vertices, drive));
    EXPECT_NEAR(rest.gap, 0, 1e-9);
    EXPECT_NEAR(rest.width, 0, 1e-9);
    EXPECT_NEAR(rest.upper_protrusion, 0, 1e-9);
    EXPECT_GT(rest.contact_mm, 15);
    EXPECT_GT(rest.teeth, 1);
    drive.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)] = 0.2;
    face.solve_equilibrium({}, drive, {.iterations = 200});
    const Mouth open = measures.at(face.pose());
    EXPECT_NEAR(open.jaw, 8.13, 0.3);
    // The lips open by less than the incisors.
    EXPECT_GT(open.gap, 4);
    EXPECT_LT(open.gap, open.jaw);
    EXPECT_GT(open.area_mm2, 80);
    EXPECT_EQ(open.contact_mm, 0);
    // A turned head is the same mouth.
    face::FacePose turned = face.pose();
    const Mat3 turn(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
    turned.vertices *= turn.transpose();
    turned.head = turn * turned.head;
    EXPECT_NEAR(measures.at(turned).gap, open.gap, 1e-9);
}

TEST(SayEvent, IsReadWithItsRanges) {
    const auto read = [](const char* text) {
        return read_say(JsonCursor::from_json(Json::parse(text), "s.json"), 4);
    };
    const SayEvent event = read(
        R"({"say": {"phones": [["a", 0.2], ["p", 0.12]]}, "start_s": 1, "style": {"jaw": 0.4},
            "sound": "none", "adjust": [{"phone": 1, "deeper_mm": 0.6}]})");
    EXPECT_EQ(event.timed_phones.size(), 2u);
    EXPECT_EQ(event.style.jaw, 0.4);
    EXPECT_FALSE(event.sound);
    EXPECT_EQ(event.adjust[0].deeper_mm, 0.6);
    EXPECT_EQ(message_of([&] { read(R"({"say": "a", "start_s": 1, "style": {"jaw": 3}})"); }),
              "s.json:/style/jaw: expected [0, 2], found 3");
    EXPECT_NE(message_of([&] {
                  read(R"({"say": {}, "start_s": 1})");
              }).find("one of \"phones\", \"labels\" and \"utterance\""),
              std::string::npos);
    EXPECT_NE(message_of([&] { read(R"({"say": "a", "start_s": 1, "speed": 1})"); }).find("speed"),
              std::string::npos);
}

TEST(CheckSpeech, EveryClosureIsPressedFromTheFirstSimulationOn) {
    const speech::PhoneTable table = speech::PhoneTable::standard();
    const auto said = speech::read_utterance(
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/talk/english.utterance.json", table);
    const auto changes = usual_changes(said, table);
    EXPECT_EQ(changes.size(), 8u);
    for (const speech::ClosureChange& change : changes) {
        EXPECT_EQ(change.deeper_mm, 2);
        EXPECT_EQ(change.earlier_s + change.shorter_s + change.wider_mm, 0);
    }
}

TEST(CheckSpeech, AClosureThatLeaksIsPressedDeeperAndALateOneBeginsEarlier) {
    ClosureCheck leaks{.phone = 3,
                       .closure_s = 1,
                       .release_s = 1.1,
                       .max_gap_mm = 0.7,
                       .least_gap_mm = 0.2,
                       .contact_s = 1.018,
                       .open_s = 1.1};
    ClosureCheck good{.phone = 5,
                      .closure_s = 2,
                      .release_s = 2.1,
                      .max_gap_mm = 0.1,
                      .least_gap_mm = 0,
                      .contact_s = 2.0,
                      .open_s = 2.11};
    const auto changes = changes_for({leaks, good}, {});
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].phone, 3);
    EXPECT_DOUBLE_EQ(changes[0].deeper_mm, 2 * 0.7 + 0.6);
    EXPECT_NEAR(changes[0].earlier_s, 2 * 0.013, 1e-9);
    const auto more = changes_for({leaks}, changes);
    EXPECT_DOUBLE_EQ(more[0].deeper_mm, 2 * (2 * 0.7 + 0.6));
}

TEST(CheckSpeech, LipsThatPartBeforeTheReleaseAreClosedForLongerAndPressAsBefore) {
    const ClosureCheck parts{.phone = 7,
                             .closure_s = 1,
                             .release_s = 1.078,
                             .max_gap_mm = 1.4,
                             .least_gap_mm = 0.06,
                             .contact_s = 1.008,
                             .open_s = 1.057,
                             .closed_until_s = 1.053};
    const auto changes = changes_for({parts}, {});
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].deeper_mm, 0);
    EXPECT_EQ(changes[0].earlier_s, 0);
    EXPECT_NEAR(changes[0].shorter_s, -0.025, 1e-9);
    // When that was not enough, they press deeper as well, and are never closed far into the sound that follows.
    const auto more = changes_for({parts}, changes);
    EXPECT_EQ(more[0].shorter_s, -0.04);
    EXPECT_DOUBLE_EQ(more[0].deeper_mm, 2 * 1.4 + 0.6);
    speech::ArticulationTargets targets{0, 2, {}, {}, {{7, 7, 1, 1.078}}, {}};
    targets.windows = {{speech::Parameter::kGap, 1.01, 1.06, -1.2, 0.02, false, 7}};
    targets.bounds = {{speech::Parameter::kGap, 1.01, 1.06, -100, -0.5, 7}};
    speech::change_closures(changes, targets);
    EXPECT_NEAR(targets.windows[0].to_s, 1.085, 1e-9);
    EXPECT_NEAR(targets.bounds[0].to_s, 1.085, 1e-9);
    EXPECT_EQ(targets.bounds[0].from_s, 1.01);
}

TEST(CheckSpeech, WhereLipsMeetTooEarlyTheSoundBeforeOpensThemFurther) {
    ClosureCheck early{.phone = 7,
                       .closure_s = 1,
                       .release_s = 1.08,
                       .max_gap_mm = 0.1,
                       .least_gap_mm = 0,
                       .contact_s = 0.965,
                       .open_s = 1.085,
                       .closed_until_s = 1.082};
    EXPECT_FALSE(early.in_time());
    const auto changes = changes_for({early}, {});
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].phone, 7);
    EXPECT_EQ(changes[0].earlier_s + changes[0].deeper_mm + changes[0].wider_mm, 0);
    EXPECT_EQ(changes[1].phone, 6);
    EXPECT_EQ(changes[1].wider_mm, 1.5);
    EXPECT_EQ(changes_for({early}, changes)[1].wider_mm, 3);
    // What was begun earlier before is taken back first.
    const auto back = changes_for({early}, {{.phone = 7, .earlier_s = 0.02}});
    ASSERT_EQ(back.size(), 1u);
    EXPECT_NEAR(back[0].earlier_s, 0.01, 1e-9);
    early.from_rest = true;
    EXPECT_TRUE(early.in_time());
    EXPECT_TRUE(changes_for({early}, {}).empty());
    early.from_rest = false;
    early.contact_s = 0.976;
    EXPECT_TRUE(early.in_time());
    EXPECT_TRUE(changes_for({early}, {}).empty());
}

TEST(CheckSpeech, AChangeThatMadeAClosureWorseIsHalved) {
    const ClosureCheck late{.phone = 7,
                            .closure_s = 1,
                            .release_s = 1.042,
                            .contact_s = 1.002,
                            .open_s = 1.07,
                            .closed_until_s = 1.065};
    ClosureCheck leaks = late, small = late, well = late;
    leaks.max_gap_mm = leaks.least_gap_mm = 2;
    small.max_gap_mm = 0.4;
    leaks.open_s = small.open_s = well.open_s = 1.05;
    const std::vector<speech::ClosureChange> none{{.phone = 7, .deeper_mm = 2}},
        too_short{{.phone = 7, .deeper_mm = 1.5, .shorter_s = 0.03}};
    TriedClosures tried;
    tried.add({late}, none);
    // Lips that press without need, and part late, press less.
    const auto first = tried.next({late}, none);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].deeper_mm, 1.5);
    EXPECT_EQ(first[0].shorter_s, 0.015);
    tried.add({leaks}, too_short);
    const auto half = tried.next({leaks}, too_short);
    EXPECT_EQ(half[0].deeper_mm, 1.75);
    EXPECT_EQ(half[0].shorter_s, 0.015);
    // A small leak of lips that open in time is pressed shut.
    EXPECT_DOUBLE_EQ(tried.next({small}, too_short)[0].deeper_mm, 1.5 + 2 * 0.4 + 0.6);
    // What is well stays, until the sounds around it make the same change worse.
    tried.add({well}, too_short);
    EXPECT_EQ(tried.next({leaks}, none)[0].shorter_s, 0.03);
    tried.add({leaks}, too_short);
    EXPECT_GT(tried.next({leaks}, too_short)[0].deeper_mm, 1.5);
}

TEST(CheckSpeech, LipsThatOpenLateAreAskedToBeApartSoonAfterTheRelease) {
    const ClosureCheck late{.phone = 7,
                            .closure_s = 1,
                            .release_s = 1.042,
                            .max_gap_mm = 0.2,
                            .least_gap_mm = 0,
                            .contact_s = 1.002,
                            .open_s = 1.091,
                            .closed_until_s = 1.08};
    const auto changes = changes_for({late}, {});
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].shorter_s, 0.015);
    speech::ArticulationTargets targets{0, 2, {}, {}, {{7, 7, 1, 1.042}}, {}};
    targets.windows = {{speech::Parameter::kGap, 0.3, 0.5, 0, 0.02, false, -1},
                       {speech::Parameter::kGap, 1.01, 1.024, -1.2, 0.02, false, 7},
                       {speech::Parameter::kGap, 1.15, 1.2, 4, 0.04, true, 8}};
    targets.bounds = {{speech::Parameter::kGap, 1.01, 1.024, -100, -0.5, 7}};
    speech::change_closures(changes, targets);
    const speech::ArticulationCurves curves = speech::curves_of(targets);
    EXPECT_LE(curves.at(speech::Parameter::kGap, 1.015), -0.4);
    for (const double t_s : {1.055, 1.06, 1.07})
        EXPECT_GE(curves.at(speech::Parameter::kGap, t_s), 0.9) << t_s;
}

}  // namespace
}  // namespace risorius::talk
