// SPDX-License-Identifier: MIT
// Pictures to measure by: things are where they are drawn, in the colour they were given.
#include "risorius/render/measure_view.h"

#include <gtest/gtest.h>

#include "risorius/core/error.h"

namespace risorius::render {
namespace {

/// A square of 2 m across the view at depth z, facing the eye.
ColouredSurface square(double z, const Vec3& colour, double opacity = 1) {
    ColouredSurface s;
    s.positions.resize(4, 3);
    s.positions << -1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z;
    s.triangles.resize(2, 3);
    s.triangles << 0, 1, 2, 0, 2, 3;
    s.colours.assign(4, colour);
    s.opacity = opacity;
    return s;
}
Vec3 colour_at(const Image& image, int x, int y) {
    const std::uint8_t* p = image.pixel(x, y);
    return Vec3(p[0], p[1], p[2]) / 255.0;
}
const MeasureViewOptions kFewPixels{.width_px = 40, .height_px = 40, .height_m = 4};

TEST(MeasureView, NearerSurfacesHideFartherOnesAndVeilsAreLaidOver) {
    const Vec3 red(1, 0, 0), green(0, 1, 0);
    EXPECT_GT(
        colour_at(draw_measured({square(0, red), square(1, green)}, {}, {}, kFewPixels), 20, 20)
            .y(),
        0.8);
    EXPECT_GT(
        colour_at(draw_measured({square(1, red), square(0, green)}, {}, {}, kFewPixels), 20, 20)
            .x(),
        0.8);
    const Vec3 both = colour_at(
        draw_measured({square(0, red), square(1, green, 0.5)}, {}, {}, kFewPixels), 20, 20);
    EXPECT_NEAR(both.x(), both.y(), 0.01);
    EXPECT_GT(both.x(), 0.4);
    // 10 px a metre: the square ends 10 px from the middle
    const Image image = draw_measured({square(0, red)}, {}, {}, kFewPixels);
    EXPECT_EQ(colour_at(image, 8, 20), Vec3(1, 1, 1));
    EXPECT_LT(colour_at(image, 11, 20).y(), 0.1);
}

TEST(MeasureView, MarksShowUnlessASurfaceHidesThem) {
    const Vec3 blue(0, 0, 1);
    const auto mark_at = [&](double z, double azimuth_deg) {
        MeasureViewOptions options = kFewPixels;
        options.azimuth_deg = azimuth_deg;
        const Image image = draw_measured({square(0, Vec3(1, 0, 0))},
                                          {{.at = Vec3(0.5, 0.5, z), .colour = blue}}, {}, options);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                if (colour_at(image, x, y).z() > 0.9 && colour_at(image, x, y).x() < 0.1)
                    return std::make_pair(x, y);
        return std::make_pair(-1, -1);
    };
    EXPECT_EQ(mark_at(-0.5, 0).first, -1);
    const auto [x, y] = mark_at(0.5, 0);
    EXPECT_NEAR(x, 25, 5);  // to the right of the middle is the subject's left
    EXPECT_NEAR(y, 15, 5);
    // From its left the face looks to the left of the picture
    EXPECT_LT(mark_at(1, 90).first, 15);
}

TEST(MeasureView, TheScaleGrowsLighter) {
    for (double fraction = 0; fraction < 1; fraction += 0.1) {
        const Vec3 weights(0.2126, 0.7152, 0.0722);  // of luminance, Rec. 709
        EXPECT_LT(scale_colour(fraction).dot(weights), scale_colour(fraction + 0.1).dot(weights));
    }
    EXPECT_EQ(scale_colour(-1), scale_colour(0));
    EXPECT_EQ(scale_colour(2), scale_colour(1));
}

TEST(MeasureView, RefusesASizeThatIsNone) {
    try {
        draw_measured({}, {}, {}, {.width_px = 0});
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "width_px, height_px: expected [1, 8192], found 0");
    }
}

}  // namespace
}  // namespace risorius::render
