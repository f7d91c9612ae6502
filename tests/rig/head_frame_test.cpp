// SPDX-License-Identifier: MIT
// A head is found however its mesh lies in space, and whatever its units.
#include "risorius/rig/detail/head_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "rig/heads.h"

namespace risorius::rig {
namespace {

const Mat3& some_turn() {
    static const Mat3 turn =
        (Eigen::AngleAxisd(2.4, Vec3(1, 2, -1).normalized()) * Eigen::AngleAxisd(-1, Vec3::UnitX()))
            .toRotationMatrix();
    return turn;
}

/// The atlas as a mesh in centimetres would have it: grown, turned and moved.
std::map<std::string, Vec3> placed_atlas(double size, const Vec3& shift_m, double noise_m = 0) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0.0, noise_m);
    std::map<std::string, Vec3> out;
    for (const AtlasLandmark& landmark : adult().rig.atlas.landmarks) {
        Vec3 jitter = Vec3::Zero();
        // In an order that no compiler chooses
        for (int k = 2; k >= 0 && noise_m > 0; --k) jitter[k] = normal(random);
        out[landmark.id] =
            (some_turn().transpose() * (size * landmark.position + jitter - shift_m)) / 0.01;
    }
    return out;
}

TEST(HeadFrame, FindsAKnownTurnPlaceAndSize) {
    const Vec3 shift(0.3, -0.2, 1.7);
    const HeadFrame frame = find_head_frame(placed_atlas(1.07, shift), adult().rig.atlas, 0.01);
    EXPECT_NEAR(frame.size, 1.07, 1e-12);
    EXPECT_LT((frame.rotation - some_turn()).norm(), 1e-12);
    EXPECT_LT((frame.translation - shift).norm(), 1e-12);
    EXPECT_LT(frame.residual_m, 1e-12);
}

TEST(HeadFrame, AFewMillimetresOfErrorTurnTheHeadLittle) {
    const HeadFrame frame =
        find_head_frame(placed_atlas(1.0, Vec3::Zero(), 2e-3), adult().rig.atlas, 0.01);
    const double turn = Eigen::AngleAxisd(frame.rotation * some_turn().transpose()).angle();
    EXPECT_LT(turn, 0.01);
    EXPECT_NEAR(frame.size, 1.0, 0.01);
    EXPECT_NEAR(frame.residual_m, 2e-3 * std::sqrt(3.0), 0.7e-3);
}

TEST(HeadFrame, TheOriginLiesBetweenTheTragia) {
    auto landmarks = placed_atlas(1.0, Vec3(1, 2, 3), 2e-3);
    const HeadFrame frame = find_head_frame(landmarks, adult().rig.atlas, 0.01);
    EXPECT_LT((frame.to_head(landmarks.at("t_l")) + frame.to_head(landmarks.at("t_r"))).norm(),
              1e-12);
    // Without them the whole of the landmarks stands in.
    landmarks.erase("t_l");
    landmarks.erase("t_r");
    const HeadFrame other = find_head_frame(landmarks, adult().rig.atlas, 0.01);
    EXPECT_LT((other.translation - frame.translation).norm(), 4e-3);
}

TEST(HeadFrame, FromMeshToHeadAndBackIsTheSame) {
    const HeadFrame frame =
        find_head_frame(placed_atlas(0.9, Vec3(1, 2, 3)), adult().rig.atlas, 0.01);
    const Points& mesh = adult().mesh.positions;
    EXPECT_LT((frame.to_mesh(frame.to_head(mesh)) - mesh).cwiseAbs().maxCoeff(), 1e-10);
    const Vec3 one = mesh.row(17).transpose();
    EXPECT_LT((frame.to_head(one) - Vec3(frame.to_head(mesh).row(17).transpose())).norm(), 1e-12);
}

TEST(HeadFrame, AMirroredHeadIsNotTurnedInsideOut) {
    // The best fit of a reflection must still be a rotation.
    auto landmarks = placed_atlas(1.0, Vec3::Zero());
    for (auto& [id, p] : landmarks) p.x() = -p.x();
    const HeadFrame frame = find_head_frame(landmarks, adult().rig.atlas, 0.01);
    EXPECT_NEAR(frame.rotation.determinant(), 1.0, 1e-12);
    EXPECT_LT((frame.rotation * frame.rotation.transpose() - Mat3::Identity()).norm(), 1e-12);
}

TEST(HeadFrame, TheAdultIsAnAverageAdult) {
    EXPECT_NEAR(adult_placed().size, 1.0, 0.02);
    EXPECT_LT(adult_placed().frame.residual_m, 2e-3);
    EXPECT_LT((adult_placed().frame.rotation - Mat3::Identity()).norm(), 0.03);
}

}  // namespace
}  // namespace risorius::rig
