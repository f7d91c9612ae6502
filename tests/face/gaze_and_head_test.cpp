// SPDX-License-Identifier: MIT
// Eyes turn by exactly the angle asked for; the head turns as one piece over shoulders that stay.
#include <gtest/gtest.h>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

using track::Kinematic;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

Face& face() {
    static Face one = adult_face();
    return one;
}

TEST(Gaze, TurnsEachEyeByItsOwnAngle) {
    track::Drive drive = with_kinematic(Kinematic::kGazeYawLeft, 20);
    drive = with_kinematic(Kinematic::kGazePitchRight, -15, drive);
    const FacePose pose = equilibrium_pose(face(), drive);
    EXPECT_LT((pose.eye_rotation[0] * Vec3::UnitZ() -
               Vec3(std::sin(20 * kDegree), 0, std::cos(20 * kDegree)))
                  .norm(),
              1e-12)
        << "yaw > 0 looks to the subject's left";
    EXPECT_LT((pose.eye_rotation[1] * Vec3::UnitZ() -
               Vec3(0, -std::sin(15 * kDegree), std::cos(15 * kDegree)))
                  .norm(),
              1e-12)
        << "pitch > 0 looks up";
    // The vertices turn with it, about the centre of the globe.
    const rig::Head& head = face().head();
    for (long v = 0; v < head.vertices.rows(); ++v)
        for (int side = 0; side < 2; ++side) {
            if (head.carrier[v] != (side == 0 ? rig::Carrier::kEyeLeft : rig::Carrier::kEyeRight))
                continue;
            const Vec3 rest = head.vertices.row(v).transpose() - head.eyes[side].centre;
            const Vec3 now = pose.vertices.row(v).transpose() - head.eyes[side].centre;
            ASSERT_LT((now - pose.eye_rotation[side] * rest).norm(), 1e-12);
        }
}

void expect_rigid(Kinematic channel, double value) {
    const FacePose pose = equilibrium_pose(face(), with_kinematic(channel, value));
    const Points& rest = face().head().vertices;
    const Vec3 nose = at(rest, "prn"), nose_now = at(pose.vertices, "prn");
    int above = 0;
    for (long v = 0; v < rest.rows(); ++v) {
        const Vec3 p = rest.row(v).transpose(), q = pose.vertices.row(v).transpose();
        if (p.y() > -65e-3) {
            ++above;
            ASSERT_NEAR((q - nose_now).norm(), (p - nose).norm(), 1e-9) << v;
            ASSERT_LT((pose.head * p - q).norm(), 1e-9) << v;
        }
    }
    EXPECT_GT(above, 3000);
    long lowest = 0;
    rest.col(1).minCoeff(&lowest);
    EXPECT_LT((rest.row(lowest) - pose.vertices.row(lowest)).norm(), 1e-12)
        << "the base of the neck moves";
    EXPECT_GT((nose - nose_now).norm(), 3e-3);
}

TEST(HeadTurn, IsRigidAboveTheJawAndLeavesTheShoulders) {
    expect_rigid(Kinematic::kHeadYaw, 30);
    // Weight aside, which a tilted head feels
    face().set_gravity(std::nullopt);
    expect_rigid(Kinematic::kHeadPitch, -20);
    expect_rigid(Kinematic::kHeadRoll, 15);
    expect_rigid(Kinematic::kHeadForward, 20);
    face().set_gravity(Vec3(0, -9.81, 0));
}

TEST(HeadTurn, GoesTheWayItSays) {
    const auto nose_of = [](Kinematic channel, double value) {
        return at(moved_mm(face(), equilibrium_pose(face(), with_kinematic(channel, value))),
                  "prn");
    };
    EXPECT_GT(nose_of(Kinematic::kHeadYaw, 20).x(), 20) << "yaw > 0 turns to the subject's left";
    EXPECT_GT(nose_of(Kinematic::kHeadPitch, 20).y(), 20) << "pitch > 0 looks up";
    EXPECT_LT((nose_of(Kinematic::kHeadForward, 12) - Vec3(0, 0, 12)).norm(), 0.2);
    const Points tilted =
        moved_mm(face(), equilibrium_pose(face(), with_kinematic(Kinematic::kHeadRoll, 20)));
    EXPECT_LT(at(tilted, "t_l").y(), -10) << "roll > 0 lowers the left ear";
    EXPECT_GT(at(tilted, "t_r").y(), 10);
}

TEST(HeadTurn, CarriesTheGazeAndAnyExpressionWithIt) {
    track::Drive drive = with_unit("AU12", 0.7);
    const Points smile = equilibrium_pose(face(), drive).vertices;
    drive = with_kinematic(Kinematic::kHeadYaw, 25, drive);
    drive = with_kinematic(Kinematic::kGazeYawLeft, 10, drive);
    const FacePose turned = equilibrium_pose(face(), drive);
    for (const char* id : {"ch_l", "mc_r", "prn", "bp_l"})
        EXPECT_LT((turned.head * at(smile, id) - at(turned.vertices, id)).norm(), 1e-4)
            << id << ": but for the lids, which go along with the eyes";
    const Vec3 looks = turned.eye_rotation[0] * Vec3::UnitZ();
    EXPECT_NEAR(std::atan2(looks.x(), looks.z()), 35 * kDegree, 1e-12);
}

TEST(HeadTurn, DoesNotTearTheNeck) {
    const FacePose pose = equilibrium_pose(face(), with_kinematic(Kinematic::kHeadYaw, 60));
    const Points& rest = face().head().vertices;
    const Triangles& skin = face().head().skin;
    double longest = 0;
    for (long f = 0; f < skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = skin(f, k), b = skin(f, (k + 1) % 3);
            const double before = (rest.row(a) - rest.row(b)).norm();
            if (before < 2e-3) continue;
            longest =
                std::max(longest, (pose.vertices.row(a) - pose.vertices.row(b)).norm() / before);
        }
    EXPECT_LT(longest, 2.5);
}

TEST(HeadTurn, CarriesTheLandmarksBesideTheMesh) {
    // Landmarks that the rig does not give are warped from the atlas and are no vertices
    rig::RigDescription rig = rig::adult().rig;
    for (const char* id : {"g", "bm_l", "ft_r"}) rig.landmarks.erase(id);
    Face one(rig, rig::adult().mesh, preview(), "adult");
    const FacePose pose = equilibrium_pose(one, with_kinematic(Kinematic::kHeadYaw, 60));
    for (const char* id : {"g", "bm_l", "ft_r"})
        EXPECT_LT((one.diagnostics().landmark(id) - pose.head * one.head().landmark(id)).norm(),
                  1e-3)
            << id;
}

}  // namespace
}  // namespace risorius::face
