// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/dense_panels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace risorius::solve::detail {
namespace {

// Widths and heights around the four columns and rows that are taken together
TEST(DensePanels, EliminateSolvesTheTriangleAndSubtractsWhatIsBelow) {
    for (int width = 1; width <= 9; ++width)
        for (int below = 0; below <= 6; ++below) {
            const int tall = width + below;
            Eigen::MatrixXd panel(tall, width);
            for (int j = 0; j < width; ++j)
                for (int i = 0; i < tall; ++i)
                    panel(i, j) = i == j ? 3 + j : 0.1 * ((7 * i + 3 * j) % 11) - 0.4;
            const Eigen::VectorXd known = Eigen::VectorXd::LinSpaced(width, -1, 2);
            const auto triangle = panel.topRows(width).triangularView<Eigen::Lower>();
            Eigen::VectorXd w = Eigen::VectorXd::Constant(tall, 0.25);
            w.head(width) = triangle * known;
            eliminate(panel.data(), tall, width, w.data());
            EXPECT_LT((w.head(width) - known).norm(), 1e-13) << width << " x " << below;
            const Eigen::VectorXd left =
                Eigen::VectorXd::Constant(below, 0.25) - panel.bottomRows(below) * known;
            EXPECT_LT((w.tail(below) - left).norm(), 1e-13) << width << " x " << below;
        }
}

}  // namespace
}  // namespace risorius::solve::detail
