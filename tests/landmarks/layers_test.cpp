// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/layers.h"

#include <gtest/gtest.h>

#include <numeric>

namespace risorius::landmarks {
namespace {

/// 0, 1, 2, ... row by row
Picture counted(int height, int width, int channels) {
    Picture out(height, width, channels);
    std::iota(out.values.begin(), out.values.end(), 0.0F);
    return out;
}

Filters filters_of(int size, int in, int out, std::vector<float> weights) {
    Filters f;
    f.rows = f.columns = size;
    f.channels_in = in;
    f.channels_out = out;
    f.weights = std::move(weights);
    return f;
}

TEST(FaceLayers, AFilterOfOnePointMixesChannels) {
    Filters f = filters_of(1, 2, 3, {1, 0, 2, 0, 1, 3});
    f.bias = {0.5F, 0, -1};
    const Picture out = convolved(counted(1, 3, 2), f);
    // Pixels (0, 1), (2, 3), (4, 5): out = (a + 0.5, b, 2 a + 3 b - 1)
    EXPECT_EQ(out.values, (std::vector<float>{0.5F, 1, 2, 2.5F, 3, 12, 4.5F, 5, 22}));
}

TEST(FaceLayers, PaddingWithAStepPutsTheLargerHalfBehind) {
    // TensorFlow's SAME: 4 pixels, a filter of 3 and a step of 2 need one zero, which stands behind. So the first sum begins at
    // the first pixel.
    Filters f = filters_of(3, 1, 1, std::vector<float>(9, 1));
    f.stride = 2;
    f.padded = true;
    const Picture in = counted(4, 4, 1);
    const std::vector<float> expected{0 + 1 + 2 + 4 + 5 + 6 + 8 + 9 + 10, 2 + 3 + 6 + 7 + 10 + 11,
                                      8 + 9 + 10 + 12 + 13 + 14, 10 + 11 + 14 + 15};
    EXPECT_EQ(convolved(in, f).values, expected);
    EXPECT_EQ(convolved_by_channel(in, f).values, expected);
}

TEST(FaceLayers, PaddingWithoutAStepIsEvenOnBothSides) {
    Filters f = filters_of(3, 1, 1, {0, 0, 0, 0, 0, 1, 0, 0, 0});  // the neighbour to the right
    f.padded = true;
    EXPECT_EQ(convolved(counted(2, 3, 1), f).values, (std::vector<float>{1, 2, 0, 4, 5, 0}));
}

TEST(FaceLayers, ASumOverManyChannelsDoesNotDependOnTheWidthOfThePicture) {
    // Blocks of pixels and of channels are filled up; what fills them must not be seen.
    std::vector<float> weights(5 * 11);
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = static_cast<float>(i % 7) * 0.1F - 0.3F;
    const Filters f = filters_of(1, 5, 11, weights);
    const Picture whole = counted(1, 9, 5), out = convolved(whole, f);
    for (int x = 0; x < 9; ++x) {
        Picture one(1, 1, 5);
        std::copy_n(whole.at(0, x), 5, one.at(0, 0));
        const Picture alone = convolved(one, f);
        for (int c = 0; c < 11; ++c) {
            EXPECT_EQ(out.at(0, x)[c], alone.at(0, 0)[c]);
            float expected = 0;
            for (int k = 0; k < 5; ++k)
                expected += whole.at(0, x)[k] * weights[static_cast<std::size_t>(k * 11 + c)];
            EXPECT_EQ(out.at(0, x)[c], expected);
        }
    }
}

TEST(FaceLayers, PoolsSlopesAndChannels) {
    EXPECT_EQ(pooled(counted(2, 4, 1), 2).values, (std::vector<float>{5, 7}));
    Picture signs(1, 2, 2);
    signs.values = {-1, -2, 3, 4};
    apply_slopes({0.5F, 0.25F}, signs);
    EXPECT_EQ(signs.values, (std::vector<float>{-0.5F, -0.5F, 3, 4}));
    EXPECT_EQ(with_channels(counted(1, 2, 1), 2).values, (std::vector<float>{0, 0, 1, 0}));
    EXPECT_EQ(sum_of(counted(1, 2, 1), counted(1, 2, 1)).values, (std::vector<float>{0, 2}));
}

}  // namespace
}  // namespace risorius::landmarks
