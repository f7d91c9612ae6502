// SPDX-License-Identifier: MIT
// Many drivers in few correctives: fitted to frames, split into sides, compressed within a budget.
#include "risorius/blendshapes/detail/low_rank.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace risorius::blendshapes {
namespace {

// Twenty vertices from right to left, ten of either side, and none in the strip between.
Points row_of_vertices() {
    Points out = Points::Zero(20, 3);
    for (int v = 0; v < 20; ++v) out(v, 0) = v < 10 ? -0.06 + 0.004 * v : 0.02 + 0.004 * (v - 9);
    return out;
}
const Points kRest = row_of_vertices();
const Eigen::VectorXd kArea = Eigen::VectorXd::Constant(20, 1e-6);
const Fade kNoFade{0, 1e-12};

DriverField driver(std::vector<int> drivers, int first, int count, double height_m) {
    DriverField out{{"", std::move(drivers)}, Points::Zero(20, 3), 0.1};
    for (int v = first; v < first + count; ++v) out.field(v, 1) = height_m * (1 + 0.1 * v);
    return out;
}

Points played(const LowRank& made, const Eigen::VectorXd& weights) {
    BlendShapeRig rig;
    rig.drivers = made.drivers;
    rig.correctives = made.correctives;
    Points out = Points::Zero(20, 3);
    rig.add_to(out, weights);
    return out;
}

TEST(LowRank, FieldsThatAreMultiplesOfOneAnotherTakeOneCorrectiveASideAndSign) {
    const std::vector<DriverField> fields{driver({0, 1}, 0, 20, 1e-3), driver({0, 2}, 0, 20, -2e-3),
                                          driver({1, 2}, 0, 20, 3e-3)};
    const LowRank made = low_rank(fields, {}, kRest, kArea, {.fade = kNoFade});
    ASSERT_EQ(made.correctives.size(), 4u);
    EXPECT_EQ(made.drivers.size(), 3u);
    EXPECT_EQ(made.bytes, 2 * 15 * 20);
    for (const Corrective& one : made.correctives)
        for (const int v : one.shape.vertex)
            EXPECT_EQ(kRest(v, 0) > 0, one.name.starts_with("correctiveLeft")) << one.name;
    const Eigen::Vector3d weights(0.5, 1, 0.25);
    Points sum = Points::Zero(20, 3);
    for (const DriverField& one : fields) sum += one.driver.value(weights) * one.field;
    EXPECT_LT((played(made, weights) - sum).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LowRank, WhatIsThereAlreadyIsRightIsLeftAloneAndWhatFramesLackIsLearnt) {
    const Eigen::Vector2d half(0.5, 1), whole(1, 1);
    const std::vector<DriverField> found{driver({0, 1}, 0, 5, 1e-3)};
    // The frame lacks just what the driver gives it
    const PlayedFrame agrees{half, 0.5 * found[0].field};
    EXPECT_LT(
        (played(low_rank(found, {agrees}, kRest, kArea, {.fade = kNoFade}), whole) - found[0].field)
            .cwiseAbs()
            .maxCoeff(),
        1e-12);
    // Twice as much: d + k (r - k d) / (k^2 + p), with k = 1/2, r = d and p = 1/4
    const PlayedFrame lacks{half, found[0].field};
    EXPECT_LT(
        (played(low_rank(found, {lacks}, kRest, kArea, {.ridge_weight = 0.25, .fade = kNoFade}),
                whole) -
         1.5 * found[0].field)
            .cwiseAbs()
            .maxCoeff(),
        1e-12);
    // Also where no driver moved anything before
    PlayedFrame elsewhere{half, Points::Zero(20, 3)};
    elsewhere.left(15, 2) = 1e-3;
    const Points learnt = played(
        low_rank(found, {elsewhere}, kRest, kArea, {.ridge_weight = 0.25, .fade = kNoFade}), whole);
    EXPECT_NEAR(learnt(15, 2), 1e-3, 1e-12);
    EXPECT_NEAR(learnt(0, 1), 0.5e-3, 1e-12);
}

TEST(LowRank, WeightsStayWithinZeroAndOne) {
    // Frames in which the first field is needed with either sign
    const std::vector<DriverField> fields{driver({0, 1}, 0, 20, 1e-3),
                                          driver({0, 2}, 0, 20, -2e-3)};
    std::vector<PlayedFrame> frames;
    for (const Eigen::Vector3d& weights :
         {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(1, 1, 1)})
        frames.push_back({weights, fields[0].driver.value(weights) * fields[0].field +
                                       fields[1].driver.value(weights) * fields[1].field});
    const LowRank made = low_rank(fields, frames, kRest, kArea, {.fade = kNoFade});
    BlendShapeRig rig;
    rig.drivers = made.drivers;
    rig.correctives = made.correctives;
    for (const PlayedFrame& frame : frames) {
        const Eigen::VectorXd values = rig.driver_values(frame.weights);
        for (const Corrective& one : made.correctives)
            EXPECT_LE(one.of_drivers.dot(values), 1 + 1e-12) << one.name;
        EXPECT_LT((played(made, frame.weights) - frame.left).cwiseAbs().maxCoeff(), 1e-12);
    }
    EXPECT_TRUE(std::any_of(made.correctives.begin(), made.correctives.end(),
                            [](const auto& one) { return one.name == "correctiveLeft1_minus"; }));
}

TEST(OneOfEach, KeepsThoseThatMatterMostUnderTheirNames) {
    std::vector<DriverField> fields{driver({0, 1}, 0, 4, 1e-3), driver({0, 2}, 5, 4, 3e-3),
                                    driver({1, 2}, 9, 4, 2e-3)};
    fields[0].driver.name = "a*b";
    fields[1].driver.name = "a*c";
    fields[2].driver.name = "b*c";
    const LowRank made = one_of_each(fields, {}, kRest, kArea, {.fade = kNoFade, .most = 2});
    ASSERT_EQ(made.correctives.size(), 2u);
    EXPECT_EQ(made.drivers.size(), 2u);
    EXPECT_EQ(made.correctives[0].name, "a_c");
    EXPECT_EQ(made.correctives[1].name, "b_c");
    EXPECT_EQ(made.correctives[1].follows(), 1);
    EXPECT_EQ(made.bytes, 15 * 8);
    const Eigen::Vector3d weights(0.5, 1, 0.25);
    EXPECT_LT((played(made, weights) - 0.125 * fields[1].field - 0.25 * fields[2].field)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-12);
}

TEST(OneOfEach, LearnsFromFramesAndKeepsToItsBudget) {
    const Eigen::Vector2d whole(1, 1);
    const std::vector<DriverField> found{driver({0, 1}, 0, 5, 1e-3)};
    const PlayedFrame twice{whole, 2 * found[0].field};
    // d + k (r - k d) / (k^2 + p), with k = 1, r = 2 d and p = 1
    const LowRank made =
        one_of_each(found, {twice}, kRest, kArea, {.ridge_weight = 1, .fade = kNoFade});
    EXPECT_LT((played(made, whole) - 1.5 * found[0].field).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE(one_of_each(found, {}, kRest, kArea, {.budget_bytes = 0}).correctives.empty());
}

TEST(LowRank, KeepsToItsBudgetByLeavingOutTheFiner) {
    std::vector<DriverField> fields{driver({0, 1}, 0, 6, 2e-3)};
    for (int v = 6; v < 10; ++v) fields[0].field(v, 1) = 0.1e-3;
    const auto made = [&](long bytes) {
        return low_rank(fields, {}, kRest, kArea,
                        {.fade = {0.02e-3, 0.06e-3}, .budget_bytes = bytes});
    };
    EXPECT_EQ(made(15 * 10).bytes, 15 * 10);
    EXPECT_EQ(made(15 * 9).bytes, 15 * 6);
    EXPECT_LT((played(made(15 * 9), Eigen::Vector2d(1, 1)) - fields[0].field).topRows(6).norm(),
              1e-12);
    EXPECT_TRUE(made(0).correctives.empty());
    EXPECT_TRUE(made(0).drivers.empty());
}

TEST(LowRank, WhatIsKeptMakesUpForWhatIsFadedAway) {
    // Two correctives of the left side; the drivers always meet. The weaker one is above the limit of the fade at a few vertices
    // only, so that the stronger one can give most of it.
    const std::vector<DriverField> fields{driver({0, 1}, 10, 10, 2e-3),
                                          driver({0, 2}, 10, 5, 0.3e-3)};
    std::vector<PlayedFrame> frames;
    for (const double w : {0.25, 0.5, 0.75, 1.0}) {
        const Eigen::Vector3d weights(1, w, w);
        Points left = Points::Zero(20, 3);
        for (const DriverField& one : fields) left += one.driver.value(weights) * one.field;
        frames.push_back({weights, left});
    }
    const Compression few{
        .ridge_weight = 0.25, .fade = {0.02e-3, 0.06e-3}, .budget_bytes = 15L * 12};
    const LowRank made = low_rank(fields, frames, kRest, kArea, few);
    EXPECT_LE(made.bytes, 15 * 12);
    double worst = 0;
    for (const PlayedFrame& frame : frames)
        worst = std::max(worst, (played(made, frame.weights) - frame.left).cwiseAbs().maxCoeff());
    EXPECT_LT(worst, 0.1e-3);
}

TEST(LowRank, KeepsWhatMattersMostWhenThereIsRoomForFew) {
    // Of the same side: the larger one, unless the smaller one is met far more often
    std::vector<DriverField> fields{driver({0, 1}, 0, 4, 2e-3), driver({0, 2}, 5, 4, 1e-3)};
    const Compression one_a_side{.fade = kNoFade, .most_of_a_side = 1};
    const auto keeps = [&] {
        return low_rank(fields, {}, kRest, kArea, one_a_side).correctives.at(0).shape.vertex.at(0);
    };
    EXPECT_EQ(keeps(), 0);
    fields[1].use = 100 * fields[0].use;
    EXPECT_EQ(keeps(), 5);
}

TEST(LowRank, KeepsThoseThatMoveMostOfBothSidesWhenThereIsRoomForFew) {
    // Four disjoint fields, those with odd vertices on the other side: each is a corrective of its own.
    std::vector<DriverField> fields{driver({0, 1}, 0, 4, 2e-3), driver({0, 2}, 4, 4, 1e-3),
                                    driver({1, 2}, 10, 4, 4e-3), driver({0, 3}, 14, 4, 3e-3)};
    const LowRank all = low_rank(fields, {}, kRest, kArea, {.fade = kNoFade}),
                  few = low_rank(fields, {}, kRest, kArea, {.fade = kNoFade, .most = 2});
    ASSERT_EQ(all.correctives.size(), 4u);
    ASSERT_EQ(few.correctives.size(), 2u);
    double weakest = 1;
    for (const auto& one : few.correctives)
        weakest = std::min(weakest, one.shape.delta.rowwise().norm().maxCoeff());
    EXPECT_NEAR(weakest, 3e-3 * (1 + 0.1 * 17), 1e-9);  // of the second largest
}

TEST(LowRank, SaysTheSameEveryTime) {
    std::vector<DriverField> fields;
    for (int t = 0; t < 12; ++t) fields.push_back(driver({t % 4, 4}, t, 8, 1e-3 * (t - 5)));
    const LowRank one = low_rank(fields, {}, kRest, kArea),
                  again = low_rank(fields, {}, kRest, kArea);
    ASSERT_EQ(one.correctives.size(), again.correctives.size());
    ASSERT_FALSE(one.correctives.empty());
    for (std::size_t c = 0; c < one.correctives.size(); ++c) {
        EXPECT_EQ(one.correctives[c].shape.delta, again.correctives[c].shape.delta);
        EXPECT_EQ(one.correctives[c].of_drivers, again.correctives[c].of_drivers);
    }
}

}  // namespace
}  // namespace risorius::blendshapes
