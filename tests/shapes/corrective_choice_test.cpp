#include "shapes/corrective_choice.h"

#include <gtest/gtest.h>

namespace risorius::shapes {
namespace {

// Two shapes and ten vertices; a corrective of their product moves some of them by so much.
OfferedCorrective offer(std::vector<int> drivers, int first, int count, double height_m, double use,
                        std::size_t group) {
    Points field = Points::Zero(10, 3);
    for (int v = first; v < first + count; ++v) field(v, 1) = height_m;
    return {{"", std::move(drivers), sparse(field)}, use, 15L * count, group};
}

const Eigen::VectorXd kArea = Eigen::VectorXd::Constant(10, 1e-6);

TEST(CorrectiveChoice, WithoutFramesTheMostUsefulForTheirSizeWithinTheBudget) {
    const std::vector<OfferedCorrective> offered{offer({0}, 0, 4, 1e-3, 3, 0),
                                                 offer({1}, 0, 2, 1e-3, 2, 1),
                                                 offer({0, 1}, 0, 1, 1e-3, 0.1, 2)};
    EXPECT_EQ(choose_correctives(offered, {}, kArea, 15 * 3), (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(choose_correctives(offered, {}, kArea, 15 * 7), (std::vector<std::size_t>{1, 0, 2}));
    EXPECT_TRUE(choose_correctives(offered, {}, kArea, 14).empty());
}

TEST(CorrectiveChoice, LeftAndRightAreKeptTogetherOrNotAtAll) {
    const std::vector<OfferedCorrective> offered{offer({0}, 0, 2, 1e-3, 5, 0),
                                                 offer({1}, 2, 2, 1e-3, 5, 0),
                                                 offer({0, 1}, 5, 1, 1e-3, 0.1, 1)};
    EXPECT_EQ(choose_correctives(offered, {}, kArea, 15 * 3), (std::vector<std::size_t>{2}));
    EXPECT_EQ(choose_correctives(offered, {}, kArea, 15 * 4), (std::vector<std::size_t>{0, 1}));
}

TEST(CorrectiveChoice, WhatTheFramesNeedComesBeforeWhatIsOfUseElsewhere) {
    // Of more use elsewhere, but the frame errs where the pair is at work, and by what the pair puts right
    const std::vector<OfferedCorrective> offered{offer({0}, 5, 2, 1e-3, 9, 0),
                                                 offer({0, 1}, 0, 2, 2e-3, 1, 1)};
    Points left = Points::Zero(10, 3);
    left.topRows(2).col(1).setConstant(2e-3);
    EXPECT_EQ(choose_correctives(offered, {}, kArea, 30), (std::vector<std::size_t>{0}));
    EXPECT_EQ(choose_correctives(offered, {{Eigen::Vector2d(1, 1), left}}, kArea, 30),
              (std::vector<std::size_t>{1}));
    EXPECT_EQ(choose_correctives(offered, {{Eigen::Vector2d(1, 1), left}}, kArea, 60),
              (std::vector<std::size_t>{1, 0}));
}

TEST(CorrectiveChoice, TwoThatPutRightTheSameAreKeptOnceAndWhatTakesFramesAwayIsNotKept) {
    Points left = Points::Zero(10, 3);
    left.topRows(2).col(1).setConstant(2e-3);
    const std::vector<OfferedCorrective> offered{offer({0, 1}, 0, 2, 2e-3, 1, 0),
                                                 offer({1, 0}, 0, 2, 2e-3, 1, 1),
                                                 offer({0}, 4, 2, 3e-3, 1, 2)};
    const Eigen::Vector2d whole(1, 1), half(0.5, 1);
    // The in-between of shape 0 does nothing where the shape is whole, and harm half way
    EXPECT_EQ(choose_correctives(offered, {{whole, left}}, kArea, 1000),
              (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(choose_correctives(offered, {{whole, left}, {half, 0.5 * left}}, kArea, 1000),
              (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace risorius::shapes
