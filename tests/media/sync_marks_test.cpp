// SPDX-License-Identifier: MIT
// Marks for machines that watch the screen: frame numbers that survive encoders, squares, luminance.
#include "risorius/media/sync_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media/pictures.h"
#include "risorius/core/error.h"
#include "risorius/media/luminance.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"

namespace risorius::media {
namespace {

TEST(SyncMarks, FrameCounterIsReadBackFromEveryFrameOfEveryKindOfVideo) {
    constexpr int kSide = 192;
    for (const char* name : {"a.mp4", "a.mov", "a.mkv", "a.webm"}) {
        const TemporaryFolder folder;
        VideoOptions options{.width_px = kSide, .height_px = 64, .fps = 60};
        if (std::string(name) != "a.mkv") options.crf = 35;  // low quality
        VideoWriter writer(folder / name, options);
        for (int n = 0; n < 40; ++n) {
            Image image = noise(kSide, 64, 1);
            draw_frame_counter(Corner::kLowerRight, 8, 700 + 37 * n, image);
            writer.append(image);
        }
        writer.finish();
        VideoReader video(folder / name);
        for (int n = 0; n < 40; ++n)
            EXPECT_EQ(read_frame_counter(Corner::kLowerRight, 8, video.frame(n)), 700 + 37 * n)
                << name;
    }
}

TEST(SyncMarks, FrameCounterIsInItsCornerAndChecksItself) {
    for (int corner = 0; corner < 4; ++corner) {
        Image image = flat(150, 60, 128, 128, 128);
        for (const int frame : {0, 1, 54321, (1 << 20) - 1}) {
            draw_frame_counter(static_cast<Corner>(corner), 4, frame, image);
            EXPECT_EQ(read_frame_counter(static_cast<Corner>(corner), 4, image), frame);
        }
        for (int other = 0; other < 4; ++other) {
            if (other == corner) continue;
            EXPECT_EQ(read_frame_counter(static_cast<Corner>(other), 4, image), std::nullopt);
        }
    }
    Image image = flat(150, 60, 0, 0, 0);
    draw_frame_counter(Corner::kUpperLeft, 4, 6, image);
    // One wrong bit.
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) image.pixel(4 * 10 + x, y)[1] = 255;
    EXPECT_EQ(read_frame_counter(Corner::kUpperLeft, 4, image), std::nullopt);
}

TEST(SyncMarks, PhotodiodeSquareIsWhiteOrBlackAndOpaque) {
    Image image(40, 30);
    draw_photodiode(Corner::kLowerLeft, 10, /*lit=*/true, image);
    EXPECT_EQ(image.pixel(9, 29)[0], 255);
    EXPECT_EQ(image.pixel(9, 20)[3], 255);
    EXPECT_EQ(image.pixel(10, 29)[3], 0);
    EXPECT_EQ(image.pixel(9, 19)[3], 0);
    draw_photodiode(Corner::kLowerLeft, 10, /*lit=*/false, image);
    EXPECT_EQ(image.pixel(9, 29)[0], 0);
    EXPECT_EQ(image.pixel(9, 29)[3], 255);
}

TEST(SyncMarks, UnknownCornerNamesTheFourAndTheNearest) {
    try {
        corner_named("lower_lfet", "--photodiode");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "--photodiode: expected one of \"upper_left\", \"upper_right\", \"lower_left\", "
                  "\"lower_right\" (did you mean \"lower_left\"?), found \"lower_lfet\"");
    }
}

TEST(Luminance, OfHalfBlackHalfWhiteIsAHalfWithFullContrast) {
    Image image = flat(20, 10, 0, 0, 0);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x)
            for (int k = 0; k < 3; ++k) image.pixel(x, y)[k] = 255;
    LuminanceMeter meter;
    const PictureMeasures first = meter.measure(image);
    EXPECT_NEAR(first.luminance_mean, 0.5, 1e-12);
    EXPECT_NEAR(first.luminance_sd, 0.5, 1e-12);
    EXPECT_NEAR(first.contrast_rms, 1, 1e-12);
    EXPECT_EQ(first.motion_energy, 0);
    // A quarter of the pixels change from white to black.
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 5; ++x)
            for (int k = 0; k < 3; ++k) image.pixel(x, y)[k] = 0;
    EXPECT_NEAR(meter.measure(image).motion_energy, 0.25, 1e-7);
    EXPECT_EQ(meter.measure(image).motion_energy, 0);
}

TEST(Luminance, OfAPictureAfterOthersIsWhatItIsAlone) {
    // The number of pixels is not a whole number of blocks. Some pixels change, some become transparent, and the others stay.
    Image image(37, 11);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = static_cast<std::uint8_t>(31 * i + i / 7);
    LuminanceMeter one_after_another;
    for (int step = 0; step < 4; ++step) {
        const Image before = image;
        for (int x = 5 * step; x < 5 * step + 9; ++x) image.pixel(x, 3 * step)[x % 4] ^= 0x5A;
        LuminanceMeter alone;
        const PictureMeasures a = one_after_another.measure(image), b = alone.measure(image);
        EXPECT_EQ(a.luminance_mean, b.luminance_mean);
        EXPECT_EQ(a.luminance_sd, b.luminance_sd);
        if (step == 0) continue;
        LuminanceMeter of_two;
        of_two.measure(before);
        EXPECT_EQ(a.motion_energy, of_two.measure(image).motion_energy);
        EXPECT_GT(a.motion_energy, 0);
    }
}

TEST(Luminance, FollowsTheCurveOfSrgbAndTheWeightsOfBt709) {
    const std::uint8_t grey[] = {118, 118, 118}, green[] = {0, 255, 0};
    EXPECT_NEAR(relative_luminance(grey), 0.1812, 1e-4);  // the grey card of photographers
    EXPECT_NEAR(relative_luminance(green), 0.7152, 1e-12);
}

TEST(Luminance, WithinAMaskIsTheMeanOfItsPixelsAlone) {
    Image image(2, 1);
    image.rgba = {255, 255, 255, 255, 0, 0, 0, 255};
    EXPECT_EQ(mean_luminance(image, {1, 0}), 1.0);
    EXPECT_EQ(mean_luminance(image, {0, 255}), 0.0);
    EXPECT_DOUBLE_EQ(mean_luminance(image, {1, 1}), 0.5);
    EXPECT_TRUE(std::isnan(mean_luminance(image, {0, 0})));
}

}  // namespace
}  // namespace risorius::media
