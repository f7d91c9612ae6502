// SPDX-License-Identifier: MIT
// Wrong landmarks are found by what the others say of them, and right ones are left alone on people of all kinds.
#include "risorius/rig/landmark_check.h"

#include <gtest/gtest.h>

#include "rig/head_variants.h"

namespace risorius::rig {
namespace {

std::map<std::string, Vec3> required_of(const std::map<std::string, Vec3>& all) {
    std::map<std::string, Vec3> out;
    for (const std::string& id : required_landmarks()) out[id] = all.at(id);
    return out;
}

/// Of the adult or of another head, all that were given.
std::map<std::string, Vec3> given_of(const TestHead& head, const geom::PolygonMesh& mesh) {
    std::map<std::string, Vec3> in_mesh;
    for (const auto& [id, mark] : head.rig.landmarks)
        in_mesh[id] =
            mark.vertex >= 0 ? Vec3(mesh.positions.row(mark.vertex).transpose()) : mark.xyz;
    const HeadFrame frame = find_head_frame(in_mesh, head.rig.atlas, head.rig.metres_per_unit);
    for (auto& [id, p] : in_mesh) p = frame.to_head(p);
    return in_mesh;
}

TEST(LandmarkCheck, RightLandmarksAreNotDoubted) {
    EXPECT_TRUE(
        doubtful_landmarks(given_of(adult(), adult().mesh), adult().rig.atlas, 1.0).empty());
    EXPECT_TRUE(
        doubtful_landmarks(required_of(adult_placed().landmarks), adult().rig.atlas, 1.0).empty());
}

// Two standard deviations of each of twenty modes of 3D faces (Li et al. 2020, ICT-FaceKit), both ways.
TEST(LandmarkCheck, NobodyWithinTwoStandardDeviationsIsDoubted) {
    const auto ict = ict_head();
    if (!ict) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    for (int mode = 0; mode < 20; ++mode)
        for (const double sigma : {-2.0, 2.0}) {
            std::vector<double> sigmas(static_cast<std::size_t>(mode) + 1, 0.0);
            sigmas.back() = sigma;
            const auto given = given_of(*ict, with_identity(ict->mesh, sigmas));
            for (const auto& marks : {given, required_of(given)})
                for (const LandmarkPrediction& p : doubtful_landmarks(marks, ict->rig.atlas, 1.0))
                    EXPECT_LT(p.expected.z(), 0.0)  // the back of a head varies more
                        << p.id << " of mode " << mode << " by " << sigma << ": " << p.ratio;
        }
}

TEST(LandmarkCheck, OneFifteenMillimetresOffIsFoundAndNoOtherBlamed) {
    const auto right = required_of(adult_placed().landmarks);
    int found = 0, tried = 0;
    for (const auto& [id, p] : right)
        for (const Vec3& off :
             {Vec3(0.015, 0, 0), Vec3(-0.015, 0, 0), Vec3(0, 0.015, 0), Vec3(0, -0.015, 0)}) {
            auto wrong = right;
            wrong[id] += off;
            const auto doubts = doubtful_landmarks(wrong, adult().rig.atlas, 1.0);
            ++tried;
            for (const LandmarkPrediction& doubt : doubts) {
                // Of a pair that is no mirror image either may be meant
                EXPECT_TRUE(doubt.id == id || doubt.id == mirrored_landmark(id))
                    << doubt.id << " instead of " << id;
                found += doubt.id == id;
            }
        }
    EXPECT_GT(found, 0.85 * tried) << "of " << tried;
}

TEST(LandmarkCheck, APredictionIsTheWarpOfTheOthers) {
    // On the atlas itself the others put every landmark where it is.
    std::map<std::string, Vec3> atlas;
    for (const AtlasLandmark& landmark : adult().rig.atlas.landmarks)
        atlas[landmark.id] = 1.1 * landmark.position + Vec3(0, 0.01, 0.02);
    for (const LandmarkPrediction& p : predict_each(atlas, adult().rig.atlas, 1.1))
        EXPECT_LT(p.off_m, 1e-9) << p.id;
}

TEST(LandmarkCheck, ExchangedPairsAreNamedWhicheverWayTheHeadLies) {
    auto marks = required_of(adult_placed().landmarks);
    EXPECT_TRUE(exchanged_pairs(marks, adult().rig.atlas).empty());
    std::swap(marks["ch_l"], marks["ch_r"]);
    EXPECT_EQ(exchanged_pairs(marks, adult().rig.atlas), std::vector<std::string>{"ch_l"});
    std::swap(marks["ex_l"], marks["ex_r"]);
    const Mat3 lying = Eigen::AngleAxisd(1.9, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (auto& [id, p] : marks) p = lying * p * 1000;
    EXPECT_EQ(exchanged_pairs(marks, adult().rig.atlas),
              (std::vector<std::string>{"ch_l", "ex_l"}));
}

}  // namespace
}  // namespace risorius::rig
