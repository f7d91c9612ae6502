// SPDX-License-Identifier: MIT
#include "risorius/scene/face_oval.h"

#include <gtest/gtest.h>

namespace risorius::scene {
namespace {

TEST(FaceOval, RowsHoldWhatItHolds) {
    const FaceOval oval({{20.5, 3}, {4, 12.5}, {6, 30}, {19, 38.2}, {33, 29}, {36.5, 13}});
    int inside = 0;
    for (int y = -1; y < 42; ++y) {
        const FaceOval::Span row = oval.pixels_of_row(y, 34);  // cuts its right edge
        for (int x = 0; x < 34; ++x) {
            const bool held = oval.contains({x + 0.5, y + 0.5});
            EXPECT_EQ(held, x >= row.first && x < row.end) << x << " " << y;
            inside += held ? 1 : 0;
        }
    }
    EXPECT_GT(inside, 600);
    EXPECT_LT(inside, 34 * 38);
}

TEST(FaceOval, OfTwoPointsHoldsNothing) {
    const FaceOval oval({{1, 1}, {5, 5}});
    EXPECT_FALSE(oval.contains({3, 3}));
    EXPECT_EQ(oval.pixels_of_row(3, 10).end, oval.pixels_of_row(3, 10).first);
}

}  // namespace
}  // namespace risorius::scene
