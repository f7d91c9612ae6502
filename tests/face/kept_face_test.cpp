// SPDX-License-Identifier: MIT
// A face that goes back to a moment does the same again, to the byte.
#include "risorius/face/kept_face.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

using track::Kinematic;

// Lips that close and stick, a jaw, cheeks, a turning head and a pull: everything that has a memory.
track::Drive busy(double t_s) {
    track::Drive drive = with_muscle("zygomaticus_major", 0.5 + 0.5 * std::sin(9 * t_s));
    drive = with_muscle("orbicularis_oris_upper_marginal", 0.8 * std::sin(5 * t_s), {}, drive);
    drive = with_kinematic(Kinematic::kJawOpen, 0.4 * std::abs(std::sin(8 * t_s)), drive);
    drive = with_kinematic(Kinematic::kHeadYaw, 30 * std::sin(4 * t_s), drive);
    if (t_s > 0.2) {
        track::Pull pull;
        pull.vertex = rig::adult().vertex("ch_l");
        pull.offset_m = Vec3(10 * (t_s - 0.2), 0, 0) * 1e-2;
        drive.pulls.push_back(pull);
    }
    return drive;
}

TEST(KeptFace, WhatFollowedFollowsAgainToTheByte) {
    for (const track::JawDrive jaw : {track::JawDrive::kChannels, track::JawDrive::kMuscles}) {
        Face face = adult_face();
        face.drive_jaw_by(jaw);
        face.start(busy);
        for (int i = 0; i < 17; ++i) face.step(busy);
        const KeptFace then = face.keep();
        EXPECT_NEAR(then.time_s(), 17.0 / 60, 1e-9);
        EXPECT_GT(then.bytes(), 100'000u);
        EXPECT_LT(then.bytes(), 8u << 20) << "a script of a minute keeps 240 of them at most";
        const Points there = face.pose().vertices;
        for (int i = 0; i < 12; ++i) face.step(busy);
        const Points first = face.pose().vertices;
        EXPECT_GT((first - there).cwiseAbs().maxCoeff(), 1e-3);
        // Something else in between: its traces must not remain.
        for (int i = 0; i < 5; ++i) face.step(always(with_muscle("frontalis_medial", 1)));
        for (int again = 0; again < 2; ++again) {
            face.go_back_to(then);
            EXPECT_EQ(face.time_s(), then.time_s());
            EXPECT_EQ((face.pose().vertices - there).cwiseAbs().maxCoeff(), 0);
            for (int i = 0; i < 12; ++i) face.step(busy);
            EXPECT_EQ((face.pose().vertices - first).cwiseAbs().maxCoeff(), 0);
        }
        // Also after a new start.
        face.start(always(with_kinematic(Kinematic::kJawOpen, 0.8)));
        face.go_back_to(then);
        for (int i = 0; i < 12; ++i) face.step(busy);
        EXPECT_EQ((face.pose().vertices - first).cwiseAbs().maxCoeff(), 0);
    }
}

}  // namespace
}  // namespace risorius::face
