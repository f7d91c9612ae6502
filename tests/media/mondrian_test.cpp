// SPDX-License-Identifier: MIT
#include "risorius/media/mondrian.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "risorius/media/tone.h"

namespace risorius::media {
namespace {

Image pattern(const Mondrian& mondrian) {
    Image image(160, 120);
    std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
    draw(mondrian, image);
    return image;
}

TEST(Mondrian, HasTheMeanAndTheDeviationThatAreAskedFor) {
    for (const bool grey : {true, false}) {
        const Image image =
            pattern({.face_px = 80, .grey = grey, .mean = 0.3, .sd = 0.15, .seed = 3});
        LuminanceSums sums;
        sums.add(image);
        // What rounding to bytes leaves
        EXPECT_NEAR(sums.mean(), 0.3, 0.002);
        EXPECT_NEAR(sums.sd(), 0.15, 0.002);
        int coloured = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
            coloured += image.rgba[i] != image.rgba[i + 1];
        EXPECT_EQ(coloured > 0, !grey);
    }
}

TEST(Mondrian, IsMadeOfRectanglesAndDependsOnlyOnItsSeed) {
    const Image image = pattern({.face_px = 80, .seed = 3});
    EXPECT_EQ(image.rgba, pattern({.face_px = 80, .seed = 3}).rgba);
    EXPECT_NE(image.rgba, pattern({.face_px = 80, .seed = 4}).rgba);
    int same = 0, all = 0;
    std::set<int> greys;
    for (int y = 0; y < 120; ++y)
        for (int x = 1; x < 160; ++x, ++all) {
            same += image.pixel(x, y)[0] == image.pixel(x - 1, y)[0];
            greys.insert(image.pixel(x, y)[0]);
        }
    EXPECT_GT(same, 0.7 * all) << "a rectangle is 8 pixels wide on average";
    EXPECT_GT(greys.size(), 30u);
}

}  // namespace
}  // namespace risorius::media
