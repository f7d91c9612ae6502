// SPDX-License-Identifier: MIT
// What every kind of video file preserves, and how unsupported combinations are rejected.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "media/pictures.h"
#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"

namespace risorius::media {
namespace {

std::string refusal(const std::string& target, VideoOptions options) {
    if (options.width_px == 0) options.width_px = kWidth, options.height_px = kHeight;
    try {
        check_target(target, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// Eight bars that are white or black: the number of the frame in binary.
Image barred_frame(int n) {
    Image image = flat(kWidth, kHeight, 16, 16, 16);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (n >> (x / 8) & 1)
                for (int k = 0; k < 3; ++k) image.pixel(x, y)[k] = 235;
    return image;
}

int number_on(const Image& image) {
    int n = 0;
    for (int bit = 0; bit < 8; ++bit)
        if (image.pixel(8 * bit + 4, kHeight / 2)[1] > 128) n |= 1 << bit;
    return n;
}

TEST(VideoForm, EveryFileGivesBackEveryFrameInOrderAtAnyRate) {
    for (const char* name : {"a.mp4", "a.mov", "a.mkv", "a.webm"})
        for (const int fps : {24, 25, 30, 50, 60, 100, 120}) {
            const TemporaryFolder folder;
            VideoWriter writer(folder / name,
                               {.width_px = kWidth, .height_px = kHeight, .fps = fps});
            for (int n = 0; n < 26; ++n) writer.append(barred_frame(n));
            writer.finish();
            VideoReader video(folder / name);
            ASSERT_EQ(video.frames(), 26) << name;
            EXPECT_NEAR(video.fps(), fps, 1e-9) << name;
            for (int n = 0; n < 26; ++n) {
                EXPECT_EQ(number_on(video.frame(n)), n) << name;
                EXPECT_NEAR(video.time_s(n), static_cast<double>(n) / fps, 0.5e-3 + 1e-9) << name;
            }
        }
}

TEST(VideoForm, LosslessIsBitForBitInEveryFile) {
    for (const char* name : {"a.mp4", "a.mov", "a.mkv", "a.webm"}) {
        const TemporaryFolder folder;
        VideoWriter writer(folder / name,
                           {.width_px = 67, .height_px = 35, .fps = 30, .lossless = true});
        for (unsigned n = 0; n < 5; ++n) writer.append(noise(67, 35, n));
        writer.finish();
        VideoReader video(folder / name);
        for (unsigned n = 0; n < 5; ++n)
            EXPECT_EQ(video.frame(static_cast<int>(n)).rgba, noise(67, 35, n).rgba) << name;
    }
}

/// Transparent on the left, half transparent in the middle, opaque on the right.
Image curtain() {
    Image image = flat(kWidth, kHeight, 180, 120, 100);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) image.pixel(x, y)[3] = x < 24 ? 0 : x < 40 ? 128 : 255;
    return image;
}

TEST(VideoForm, TransparencyIsKeptWhereTheFormatCan) {
    for (const char* name : {"a.mov", "a.mkv", "a.webm"}) {
        const TemporaryFolder folder;
        VideoWriter writer(folder / name, {.width_px = kWidth, .height_px = kHeight, .fps = 30});
        for (int n = 0; n < 3; ++n) writer.append(curtain());
        writer.finish();
        const Image back = VideoReader(folder / name).frame(2);
        EXPECT_NEAR(back.pixel(10, 20)[3], 0, 3) << name;
        EXPECT_NEAR(back.pixel(32, 20)[3], 128, 3) << name;
        EXPECT_NEAR(back.pixel(56, 20)[3], 255, 3) << name;
        EXPECT_NEAR(back.pixel(56, 20)[0], 180, 4) << name;
    }
    const TemporaryFolder folder;
    VideoOptions options{.width_px = kWidth, .height_px = kHeight, .fps = 30, .lossless = true};
    VideoWriter writer(folder / "a.mov", options);
    writer.append(noise(kWidth, kHeight, 3, /*opaque=*/false));
    writer.finish();
    EXPECT_EQ(VideoReader(folder / "a.mov").frame(0).rgba,
              noise(kWidth, kHeight, 3, /*opaque=*/false).rgba);
}

TEST(VideoForm, FramesMayBecomeTransparentLaterWhenTheOptionsSaySo) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "a.mkv", {.width_px = kWidth, .height_px = kHeight, .alpha = true});
    writer.append(flat(kWidth, kHeight, 10, 20, 30));
    writer.append(curtain());
    writer.finish();
    EXPECT_EQ(VideoReader(folder / "a.mkv").frame(1).rgba, curtain().rgba);
}

TEST(VideoForm, ColourAtFullSizeKeepsAnEdgeThatHalfSizeBlurs) {
    Image image = flat(kWidth, kHeight, 255, 0, 0);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; x += 2) {
            image.pixel(x, y)[0] = 0;
            image.pixel(x, y)[2] = 255;
        }
    const auto red_beside_blue = [&](const char* name, const char* pixels) {
        const TemporaryFolder folder;
        VideoOptions options{.width_px = kWidth, .height_px = kHeight, .crf = 1};
        options.pixels = pixels;
        VideoWriter writer(folder / name, options);
        writer.append(image);
        writer.finish();
        const Image back = VideoReader(folder / name).frame(0);
        return back.pixel(31, 20)[0] - back.pixel(30, 20)[0];
    };
    for (const char* name : {"a.mp4", "a.mov", "a.webm"}) {
        EXPECT_GT(red_beside_blue(name, "yuv444p"), 240) << name;
        EXPECT_LT(red_beside_blue(name, "yuv420p"), 150) << name;
    }
}

TEST(VideoForm, QualityPresetAndKeyFramesReachTheEncoder) {
    const auto size_with = [](const char* name, std::optional<int> crf,
                              std::optional<std::string> preset, std::optional<int> keys) {
        const TemporaryFolder folder;
        VideoWriter writer(folder / name, {.width_px = kWidth,
                                           .height_px = kHeight,
                                           .crf = crf,
                                           .preset = preset,
                                           .keyframe_interval = keys});
        for (int n = 0; n < 12; ++n) writer.append(noise(kWidth, kHeight, 5));
        writer.finish();
        return std::filesystem::file_size(folder / name);
    };
    for (const char* name : {"a.mp4", "a.webm"}) {
        const auto usual = size_with(name, {}, {}, 12);
        EXPECT_LT(size_with(name, 45, {}, 12), usual) << name;
        EXPECT_GT(size_with(name, {}, {}, 1), 2 * usual) << "a still picture, whole every time";
    }
    EXPECT_NE(size_with("a.mp4", {}, "ultrafast", 12), size_with("a.mp4", {}, "slow", 12));
}

/// All samples of a PNG, as libpng's own reader gives them.
std::vector<std::uint16_t> samples_of_png16(const std::filesystem::path& file, int& bits) {
    std::FILE* in = std::fopen(file.c_str(), "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, in);
    png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    bits = png_get_bit_depth(png, info);
    std::vector<std::uint16_t> out;
    for (png_uint_32 y = 0; y < png_get_image_height(png, info); ++y) {
        const auto* row = reinterpret_cast<const std::uint16_t*>(png_get_rows(png, info)[y]);
        out.insert(out.end(), row, row + png_get_rowbytes(png, info) / 2);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(in);
    return out;
}

TEST(VideoForm, PngFramesOf16BitsHoldTheDeepPixels) {
    const TemporaryFolder folder;
    VideoOptions options{.width_px = 8, .height_px = 4};
    options.bits = 16;
    Image shallow = noise(8, 4, 1), deep = noise(8, 4, 2, /*opaque=*/false);
    for (std::size_t i = 0; i < deep.rgba.size(); ++i)
        deep.deep.push_back(static_cast<std::uint16_t>(deep.rgba[i] * 256 + 37));
    VideoWriter writer(folder / "frames/", options);
    writer.append(shallow);
    writer.append(deep);
    writer.finish();
    int bits = 0;
    EXPECT_EQ(samples_of_png16(folder / "frames/frame_000001.png", bits), deep.deep);
    EXPECT_EQ(bits, 16);
    const std::vector<std::uint16_t> spread =
        samples_of_png16(folder / "frames/frame_000000.png", bits);
    ASSERT_EQ(spread.size(), 8u * 4u * 3u);
    EXPECT_EQ(spread[4], shallow.pixel(1, 0)[1] * 257);
}

TEST(VideoForm, RefusesWhatAFormDoesNotHave) {
    EXPECT_EQ(refusal("a.mkv", {.crf = 18}),
              "a.mkv: expected an ending whose quality (crf) can be chosen, .mp4, .mov or .webm, "
              "found \".mkv\"");
    EXPECT_EQ(refusal("a.webm", {.crf = 64}),
              "a.webm: expected a quality (crf) in [0, 63], found 64");
    EXPECT_EQ(refusal("a.webm", {.preset = "slow"}),
              "a.webm: expected an ending with encoder presets, .mp4 or .mov, found \".webm\"");
    EXPECT_EQ(refusal("f/", {.pixels = "yuv444p"}),
              "f/: expected an ending whose pixel format can be chosen, .mp4, .mov or .webm, found "
              "a folder of PNG frames");
    EXPECT_EQ(refusal("a.mp4", {.pixels = "yuv420"}),
              "a.mp4: expected a pixel format, one of yuv420p yuv444p (did you mean \"yuv420p\"?), "
              "found \"yuv420\"");
    EXPECT_EQ(refusal("a.mkv", {.keyframe_interval = 5}),
              "a.mkv: expected an ending whose key frames can be chosen, .mp4, .mov or .webm (in "
              "others every frame is one), found \".mkv\"");
    EXPECT_EQ(refusal("a.mp4", {.keyframe_interval = 0}),
              "a.mp4: expected frames from one key frame to the next in [1, 100000], found 0");
    EXPECT_EQ(refusal("a.mp4", {.crf = 3, .lossless = true}),
              "a.mp4: expected an option that goes with lossless, found a quality (crf)");
    EXPECT_EQ(refusal("a.mp4", {.bits = 16}),
              "a.mp4: expected a folder of PNG frames (frames/) or .mkv, whose bits can be chosen, "
              "found \".mp4\"");
    EXPECT_EQ(refusal("a.mkv", {.bits = 12}), "a.mkv: expected 8 or 16 bits per channel, found 12");
    EXPECT_EQ(refusal("f/", {.bits = 12}), "f/: expected 8 or 16 bits per channel, found 12");
    EXPECT_EQ(refusal("a.mp4", {.alpha = true}),
              "a.mp4: expected an ending that keeps transparency, .mkv, .mov, .webm or /, found "
              "\".mp4\"");
    EXPECT_EQ(refusal("a.webm", {.lossless = true, .alpha = true}),
              "a.webm: expected an ending that keeps transparency without loss, .mkv, .mov or /, "
              "found \".webm\"");
    EXPECT_EQ(refusal("a.mov", {.crf = 9, .alpha = true}),
              "a.mov: expected no options of H.264: transparent .mov files are ProRes 4444, or PNG "
              "with lossless, found a quality (crf)");
    EXPECT_EQ(refusal("a.webm", {.width_px = 65, .height_px = 48}),
              "a.webm: expected an even width and height for .webm (its colour is stored at half "
              "size), found 65 x 48");
    EXPECT_EQ(refusal("a.mp4", {.width_px = 65, .height_px = 49, .pixels = "yuv444p"}), "no error");
    EXPECT_EQ(refusal("a.mkv", {.lossless = true}), "no error");
    const auto sound = std::make_shared<Recording>();
    sound->channels = 6;
    EXPECT_EQ(refusal("a.mp4", {.sound = sound}),
              "a.mp4: expected a number of sound channels in [1, 2], found 6");
    EXPECT_EQ(refusal("a.mkv", {.sound = sound}), "no error");
    EXPECT_EQ(refusal("f/", {.sound = sound}),
              "f/: expected an ending that can hold sound, .mp4, .mov, .mkv or .webm, found a "
              "folder of PNG frames");
}

}  // namespace
}  // namespace risorius::media
