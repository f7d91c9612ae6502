// SPDX-License-Identifier: MIT
// Names and intensities as drives: as a script would.
#include "risorius/rig/expression_drive.h"

#include <gtest/gtest.h>

#include "rig/heads.h"

namespace risorius::rig {
namespace {

const RigDescription& rig() { return adult().rig; }

Eigen::VectorXd excitation_at(const std::string& name, double intensity) {
    return expansion_at(rig(), name, intensity).value().excitation;
}

TEST(ExpansionAt, AUnitFollowsItsCurve) {
    const track::ActionUnit& unit = *rig().facs.find("AU12");
    const Eigen::VectorXd whole = expansion_at(rig(), "AU12", 1).value().excitation;
    ASSERT_GT(whole.maxCoeff(), 0);
    for (const double intensity : {0.25, 0.5, 0.8, 1.0})
        EXPECT_TRUE(excitation_at("AU12", intensity)
                        .isApprox(unit.curve.muscles.activation(intensity) * whole))
            << intensity;
    // Half of the motion takes less than half of the excitation.
    EXPECT_LT(excitation_at("AU12", 0.5).sum(), 0.4 * whole.sum());
}

TEST(ExpansionAt, SidesAddUpToTheWhole) {
    EXPECT_TRUE((excitation_at("AU12.l", 0.6) + excitation_at("AU12.r", 0.6))
                    .isApprox(excitation_at("AU12", 0.6)));
}

TEST(ExpansionAt, AnExpressionIsTheSumOfItsUnitsAndMuscles) {
    const track::ChannelTable channels = rig().channels();
    for (const char* name : {"happiness", "surprise"}) {
        const track::Expression& expression = *rig().expressions.find(name);
        track::Expansion sum = track::Expansion::none(channels);
        for (const track::ExpressionUnit& part : expression.parts.units)
            sum.add(expansion_at(rig(), part.use.unit, 0.7 * part.use.value).value(), 1);
        for (const track::MuscleFraction& part : expression.parts.muscles)
            sum.add(track::expand(part, channels),
                    track::curve_of_added_muscles().muscles.activation(0.7));
        EXPECT_TRUE(excitation_at(name, 0.7).isApprox(sum.excitation)) << name;
        EXPECT_GT(sum.excitation.maxCoeff(), 0.05);
    }
}

TEST(ExpansionAt, MusclesShapesAndChannelsAreProportional) {
    EXPECT_TRUE(excitation_at("zygomaticus_major.l", 0.3)
                    .isApprox(0.3 * excitation_at("zygomaticus_major.l", 1)));
    EXPECT_TRUE(excitation_at("mouthSmileLeft", 0.3)
                    .isApprox(0.3 * expansion_at(rig(), "mouthSmileLeft", 1).value().excitation));
    const track::Expansion open = expansion_at(rig(), "jaw_open", 0.4).value();
    EXPECT_EQ(open.kinematic[static_cast<std::size_t>(track::kinematic_named("jaw_open").front())],
              0.4);
    EXPECT_EQ(open.excitation.cwiseAbs().maxCoeff(), 0);
}

TEST(ExpansionAt, UnitsWhoseNameEndsWithASideAreFound) {
    const track::Expansion left = expansion_at(rig(), "AU30.l", 1).value();
    EXPECT_NE(left.kinematic[static_cast<std::size_t>(track::kinematic_named("jaw_side").front())],
              0);
}

// The tables have "cheekPuff" as a whole, and "mouthSmileLeft" and "mouthSmileRight".
TEST(ExpansionAt, SidesOfShapesAddUpToTheShape) {
    EXPECT_TRUE((excitation_at("cheekPuff_L", 1) + excitation_at("cheekPuff_R", 1))
                    .isApprox(excitation_at("cheekPuff", 1)));
    EXPECT_TRUE((excitation_at("mouthSmile_L", 1) + excitation_at("mouthSmileRight", 1))
                    .isApprox(excitation_at("mouthSmile", 1)));
}

TEST(ExpansionAt, KnowsNoOtherNamesAndNoSidesOfWhatHasNone) {
    EXPECT_FALSE(expansion_at(rig(), "AU99", 1));
    EXPECT_FALSE(expansion_at(rig(), "AU26.l", 1));
    EXPECT_FALSE(expansion_at(rig(), "orbicularis_oris_upper_marginal.l", 1));
    EXPECT_FALSE(expansion_at(rig(), "smiling", 1));
}

}  // namespace
}  // namespace risorius::rig
