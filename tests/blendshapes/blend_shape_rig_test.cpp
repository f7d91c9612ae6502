// SPDX-License-Identifier: MIT
// Shapes add up by weight, and correctives come in by the rule that files state for them.
#include "risorius/blendshapes/detail/blend_shape_rig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::blendshapes {
namespace {

SparseShape one_vertex(int vertex, const Vec3& delta) {
    SparseShape out;
    out.vertex = {vertex};
    out.delta = delta.transpose();
    return out;
}

BlendShapeRig three_shapes() {
    BlendShapeRig rig;
    for (int k = 0; k < 3; ++k) rig.shapes.push_back(one_vertex(k, Vec3::UnitX()));
    rig.drivers = {{"0*1", {0, 1}}, {"2~2", {2}, 2}};
    rig.correctives.push_back({"one", one_vertex(3, Vec3::UnitY()), Eigen::Vector2d(1, 0)});
    rig.correctives.push_back({"other", one_vertex(4, Vec3::UnitZ()), Eigen::Vector2d(2, -0.5)});
    return rig;
}

TEST(BlendShapeRig, AddsShapesAndWhatTheirSumLacks) {
    Points vertices = Points::Zero(5, 3);
    three_shapes().add_to(vertices, Eigen::Vector3d(0.5, 0.5, 0.25));
    EXPECT_EQ(vertices(0, 0), 0.5);
    EXPECT_EQ(vertices(2, 0), 0.25);
    EXPECT_EQ(vertices(3, 1), 0.25);                              // the product
    EXPECT_EQ(vertices(4, 2), 0.5 - 0.5 * 16 * 0.0625 * 0.5625);  // less 16 w^2 (1 - w)^2
    const Eigen::VectorXd all = three_shapes().all_weights(Eigen::Vector3d(0.5, 0.5, 0.25));
    ASSERT_EQ(all.size(), 5);
    EXPECT_EQ(all[3], 0.25);
    EXPECT_EQ(all[4], vertices(4, 2));
}

// Blender and others cut what lies outside of 0 and 1, so that nothing may.
TEST(BlendShapeRig, HoldsWeightsOfCorrectivesWithinZeroAndOne) {
    const BlendShapeRig rig = three_shapes();
    EXPECT_EQ(rig.all_weights(Eigen::Vector3d(1, 1, 0))[4], 1.0);    // 2
    EXPECT_EQ(rig.all_weights(Eigen::Vector3d(0, 0, 0.5))[4], 0.0);  // -1/2
    Points vertices = Points::Zero(5, 3);
    rig.add_to(vertices, Eigen::Vector3d(1, 1, 0));
    EXPECT_EQ(vertices(4, 2), 1.0);
    EXPECT_EQ(rig.correctives[0].follows(), 0);
    EXPECT_FALSE(rig.correctives[1].follows());
}

TEST(Driver, GivesItsNameToATarget) {
    EXPECT_EQ((Driver{"jawOpen*mouthSmileLeft", {0, 1}}.target_name()), "jawOpen_mouthSmileLeft");
    EXPECT_EQ((Driver{"eyeBlinkLeft~3", {0}, 3}.target_name()), "eyeBlinkLeft_75");
    EXPECT_EQ((Driver{"viseme_PP~1left", {0}, 1}.target_name()), "viseme_PP_25left");
}

TEST(Driver, OfOneShapeIsThereOnItsWayAndGoesAsOthersCome) {
    const auto at = [](double w, int part) {
        return Driver{"", {0}, part}.value(Eigen::VectorXd::Constant(1, w));
    };
    // The parts of the way, and what is left for its ends, add up to 1 everywhere
    for (const double w : {0.0, 0.1, 0.5, 0.9, 1.0})
        EXPECT_NEAR(std::pow(1 - w, 4) + 27.0 / 64 * (at(w, 1) + at(w, 3)) + 0.375 * at(w, 2) +
                        std::pow(w, 4),
                    1, 1e-15);
    EXPECT_NEAR(at(0.25, 1), 1, 1e-15);  // the largest
    EXPECT_EQ(at(0.5, 2), 1);
    EXPECT_EQ(at(0.25, 3), at(0.75, 1));
    const Driver fading{"", {2}, 2, {0, 1}};
    EXPECT_EQ(fading.value(Eigen::Vector3d(0, 0, 0.5)), 1);
    EXPECT_EQ(fading.value(Eigen::Vector3d(0.5, 0.25, 0.5)), 0.375);
    EXPECT_EQ(fading.value(Eigen::Vector3d(1, 0, 0.5)), 0.0);
}

TEST(Driver, OfSeveralIsTheirProductAndMayGoBeforeTheyAreWhole) {
    EXPECT_EQ((Driver{"", {0, 1}}.value(Eigen::Vector2d(0.5, 0.25))), 0.125);
    EXPECT_EQ((Driver{"", {0, 1}, 0, {0}}.value(Eigen::Vector2d(0.5, 1))), 0.25);
    EXPECT_EQ((Driver{"", {0, 1}, 0, {0}}.value(Eigen::Vector2d(1, 1))), 0.0);
}

TEST(BlendShapeRig, LeavesWholeShapesAlone) {
    const BlendShapeRig rig = three_shapes();
    for (int s = 0; s < 3; ++s) {
        const Eigen::VectorXd weights = Eigen::VectorXd::Unit(3, s);
        Points vertices = Points::Zero(5, 3);
        rig.add_to(vertices, weights);
        EXPECT_EQ(vertices, rig.shapes[static_cast<std::size_t>(s)].dense(5)) << s;
    }
}

TEST(BlendShapeRig, ErrorsAreWeightedByArea) {
    Points one = Points::Zero(3, 3), other = Points::Zero(3, 3);
    other(0, 0) = 3e-3;
    other(2, 0) = 1;  // where nothing is compared
    const FieldError error = error_between(one, other, Eigen::Vector3d(1, 8, 0));
    EXPECT_NEAR(error.rms_m, 1e-3, 1e-15);
    EXPECT_EQ(error.max_m, 3e-3);
}

}  // namespace
}  // namespace risorius::blendshapes
