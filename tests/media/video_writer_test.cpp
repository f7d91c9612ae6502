// SPDX-License-Identifier: MIT
// Videos are written and read back: every frame once, at its time, with its colour. A failed write leaves nothing.
#include "risorius/media/video_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>

#include "media/pictures.h"
#include "risorius/core/error.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"

namespace risorius::media {
namespace {

using Names = std::set<std::string>;

/// A frame whose brightness tells its number, in steps of 4 levels, with a gradient as work for the encoder.
Image numbered_frame(int n) {
    Image image = flat(kWidth, kHeight, 16 + 4 * n, 16 + 4 * n, 16 + 4 * n);
    for (int y = 0; y < kHeight / 4; ++y)
        for (int x = 0; x < kWidth; ++x) image.pixel(x, y)[0] = static_cast<std::uint8_t>(x * 4);
    return image;
}

double mean_green(const Image& image) {
    double sum = 0;
    for (int y = kHeight / 2; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) sum += image.pixel(x, y)[1];
    return sum / (kWidth * kHeight / 2);
}

VideoOptions options(int fps = 60) {
    return {.width_px = kWidth, .height_px = kHeight, .fps = fps};
}

void write_numbered(const std::filesystem::path& target, int frames, int fps = 60) {
    VideoWriter writer(target, options(fps));
    for (int n = 0; n < frames; ++n) writer.append(numbered_frame(n));
    EXPECT_EQ(writer.frames(), frames);
    writer.finish();
}

std::string message_of(const std::filesystem::path& target, const VideoOptions& wanted) {
    try {
        check_target(target, wanted);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// Types of the top-level boxes of an MP4 file, in order (ISO 14496-12: 32-bit length, then type).
std::vector<std::string> boxes(const std::string& mp4) {
    std::vector<std::string> types;
    for (std::size_t at = 0; at + 8 <= mp4.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = (length << 8) | static_cast<unsigned char>(mp4[at + i]);
        types.push_back(mp4.substr(at + 4, 4));
        if (length < 8) break;
        at += length;
    }
    return types;
}

TEST(VideoWriter, Mp4HoldsEveryFrameOnceInOrderAtExactTimes) {
    for (int fps : {24, 25, 30, 60, 120}) {
        const TemporaryFolder folder;
        write_numbered(folder / "a.mp4", 40, fps);
        VideoReader video(folder / "a.mp4");
        ASSERT_EQ(video.frames(), 40);
        EXPECT_EQ(video.width_px(), kWidth);
        EXPECT_EQ(video.height_px(), kHeight);
        EXPECT_EQ(video.fps(), fps);
        for (int n = 0; n < 40; ++n) {
            // The clock of the file is a whole multiple of fps, so only the division rounds.
            EXPECT_NEAR(video.time_s(n), static_cast<double>(n) / fps, 1e-12);
            EXPECT_NEAR(mean_green(video.frame(n)), 16 + 4 * n, 1.0) << "frame " << n;
        }
    }
}

TEST(VideoWriter, MatroskaHoldsEveryFrameBitForBit) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "a.mkv", {.width_px = 67, .height_px = 35, .fps = 30});
    for (unsigned n = 0; n < 12; ++n) writer.append(noise(67, 35, n));
    writer.finish();
    VideoReader video(folder / "a.mkv");
    ASSERT_EQ(video.frames(), 12);
    EXPECT_EQ(video.width_px(), 67);
    EXPECT_EQ(video.height_px(), 35);
    EXPECT_EQ(video.fps(), 30.0);
    for (int n = 0; n < 12; ++n) {
        EXPECT_EQ(video.frame(n).rgba, noise(67, 35, static_cast<unsigned>(n)).rgba)
            << "frame " << n;
        // Matroska rounds to a millisecond.
        EXPECT_NEAR(video.time_s(n), n / 30.0, 0.5e-3 + 1e-9);
    }
}

TEST(VideoWriter, MatroskaKeepsTransparencyBitForBit) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "a.mkv", options());
    for (unsigned n = 0; n < 3; ++n) writer.append(noise(kWidth, kHeight, n, /*opaque=*/false));
    writer.finish();
    VideoReader video(folder / "a.mkv");
    for (int n = 0; n < 3; ++n)
        EXPECT_EQ(video.frame(n).rgba,
                  noise(kWidth, kHeight, static_cast<unsigned>(n), /*opaque=*/false).rgba);
}

TEST(VideoWriter, MatroskaKeepsSixteenBitsWithTransparency) {
    const TemporaryFolder folder;
    VideoOptions deep = options();
    deep.bits = 16;
    const auto picture = [](unsigned n) {
        Image image = noise(kWidth, kHeight, n, /*opaque=*/false);
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
            image.deep.push_back(static_cast<std::uint16_t>(257 * image.rgba[i] ^ (i * 31 & 63)));
            image.rgba[i] = static_cast<std::uint8_t>((image.deep[i] + 128U) / 257U);
        }
        return image;
    };
    for (const bool alpha : {true, false}) {
        const std::filesystem::path file = folder / (alpha ? "a.mkv" : "b.mkv");
        VideoWriter writer(file, deep);
        for (unsigned n = 0; n < 3; ++n) {
            Image image = picture(n);
            for (std::size_t i = 3; !alpha && i < image.deep.size(); i += 4) {
                image.deep[i] = 65535;
                image.rgba[i] = 255;
            }
            writer.append(image);
        }
        // Bytes alone become 257 times as much.
        writer.append(noise(kWidth, kHeight, 7, !alpha));
        writer.finish();
        VideoReader video(file);
        for (int n = 0; n < 3; ++n) {
            const Image read = video.frame(n), wanted = picture(static_cast<unsigned>(n));
            ASSERT_EQ(read.deep.size(), wanted.deep.size());
            for (std::size_t i = 0; i < wanted.deep.size(); ++i)
                if (alpha || i % 4 != 3) {
                    ASSERT_EQ(read.deep[i], wanted.deep[i]) << n << " " << i;
                    ASSERT_EQ(read.rgba[i], wanted.rgba[i]) << n << " " << i;
                }
        }
        EXPECT_EQ(video.frame(3).rgba, noise(kWidth, kHeight, 7, !alpha).rgba);
    }
}

TEST(VideoWriter, FolderHoldsEveryFrameBitForBit) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "frames/", options());
    for (unsigned n = 0; n < 3; ++n) writer.append(noise(kWidth, kHeight, n, n != 1));
    writer.finish();
    EXPECT_EQ(folder.listing(), (Names{"frames", "frames/frame_000000.png",
                                       "frames/frame_000001.png", "frames/frame_000002.png"}));
    for (unsigned n = 0; n < 3; ++n)
        EXPECT_EQ(read_png(folder / ("frames/frame_00000" + std::to_string(n) + ".png")).rgba,
                  noise(kWidth, kHeight, n, n != 1).rgba);
}

TEST(VideoWriter, FramesCanBeReadInAnyOrder) {
    const TemporaryFolder folder;
    write_numbered(folder / "a.mp4", 50);
    VideoReader video(folder / "a.mp4");
    for (int n : {49, 0, 17, 16, 15, 14, 30, 31, 3, 49})
        EXPECT_NEAR(mean_green(video.frame(n)), 16 + 4 * n, 1.0) << "frame " << n;
}

TEST(VideoWriter, Mp4CarriesFlatColoursThroughTheBt709Matrix) {
    // 8-bit limited-range Y'CbCr rounds by up to half a level of 219 or 224. The matrix turns this into at most 0.5 * 255/219 +
    // 0.5 * 1.8556 * 255/224 < 2 levels of R'G'B'. crf 0 would add nothing, crf 18 about one more. The BT.601 matrix in either
    // direction would change saturated colours by 20 levels or more.
    const int colours[][3] = {{255, 255, 255}, {0, 0, 0},      {128, 128, 128}, {255, 0, 0},
                              {0, 255, 0},     {0, 0, 255},    {255, 255, 0},   {0, 255, 255},
                              {255, 0, 255},   {200, 150, 120}};
    for (const auto& colour : colours) {
        const TemporaryFolder folder;
        VideoWriter writer(folder / "a.mp4", options());
        for (int n = 0; n < 3; ++n)
            writer.append(flat(kWidth, kHeight, colour[0], colour[1], colour[2]));
        writer.finish();
        const Image back = VideoReader(folder / "a.mp4").frame(2);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(back.pixel(20, 20)[channel], colour[channel], 3)
                << "colour " << colour[0] << " " << colour[1] << " " << colour[2];
    }
}

TEST(VideoWriter, Mp4NamesItsColourSpaceInTheContainer) {
    const TemporaryFolder folder;
    write_numbered(folder / "a.mp4", 2);
    // ISO 14496-12 "colr" box, type "nclx": primaries, transfer and matrix 1 = BT.709, then the full-range bit, 0.
    const std::string wanted("colrnclx\0\1\0\1\0\1\0", 15);
    EXPECT_NE(bytes_of(folder / "a.mp4").find(wanted), std::string::npos);
}

TEST(VideoWriter, Mp4HasItsIndexBeforeItsPictures) {
    const TemporaryFolder folder;
    write_numbered(folder / "a.mp4", 5);
    const std::vector<std::string> order = boxes(bytes_of(folder / "a.mp4"));
    const auto index = std::find(order.begin(), order.end(), "moov");
    const auto pictures = std::find(order.begin(), order.end(), "mdat");
    ASSERT_NE(index, order.end());
    ASSERT_NE(pictures, order.end());
    EXPECT_LT(index, pictures);
}

TEST(VideoWriter, SameFramesMakeTheSameBytes) {
    const TemporaryFolder folder;
    for (const char* ending : {".mp4", ".mov", ".mkv", ".webm"}) {
        write_numbered(folder / ("a" + std::string(ending)), 30);
        write_numbered(folder / ("b" + std::string(ending)), 30);
        const std::string a = bytes_of(folder / ("a" + std::string(ending)));
        ASSERT_FALSE(a.empty());
        EXPECT_TRUE(a == bytes_of(folder / ("b" + std::string(ending)))) << ending;
    }
}

TEST(VideoWriter, SameFramesMakeTheSameBytesWhereverInMemory) {
    const TemporaryFolder folder;
    std::vector<std::vector<char>> between;
    std::set<std::string> files;
    for (std::size_t k = 0; k < 60; ++k) {
        between.emplace_back(16 + 1337 * k);
        write_numbered(folder / "a.mp4", 30);
        files.insert(bytes_of(folder / "a.mp4"));
    }
    EXPECT_EQ(files.size(), 1u);
}

TEST(VideoWriter, AbandonedWriterLeavesNothing) {
    for (const char* name : {"new/a.mp4", "new/a.mov", "new/a.mkv", "new/a.webm", "new/frames/"}) {
        const TemporaryFolder folder;
        {
            VideoWriter writer(folder / name, options());
            for (int n = 0; n < 5; ++n) writer.append(numbered_frame(n));
            EXPECT_FALSE(folder.listing().contains(name));
        }
        EXPECT_EQ(folder.listing(), Names{}) << name;
    }
}

TEST(VideoWriter, AbandonedWriterLeavesTheVideoThatWasThere) {
    const TemporaryFolder folder;
    write_numbered(folder / "a.mp4", 3);
    const std::string before = bytes_of(folder / "a.mp4");
    {
        VideoWriter writer(folder / "a.mp4", options());
        writer.append(numbered_frame(0));
    }
    EXPECT_TRUE(bytes_of(folder / "a.mp4") == before);
    EXPECT_EQ(folder.listing(), Names{"a.mp4"});
}

TEST(VideoWriter, FinishedVideoReplacesAnEarlierOne) {
    const TemporaryFolder folder;
    for (const char* name : {"a.mp4", "a.mkv", "frames/"}) {
        write_numbered(folder / name, 5);
        write_numbered(folder / name, 3);
    }
    EXPECT_EQ(VideoReader(folder / "a.mp4").frames(), 3);
    EXPECT_EQ(VideoReader(folder / "a.mkv").frames(), 3);
    EXPECT_EQ(folder.listing(), (Names{"a.mp4", "a.mkv", "frames", "frames/frame_000000.png",
                                       "frames/frame_000001.png", "frames/frame_000002.png"}));
}

/// Limits the size of every file of this process, as a full disk would.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        before_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, before_handler_);
    }

  private:
    rlimit before_{};
    void (*before_handler_)(int) = nullptr;
};

TEST(VideoWriter, FailedWriteIsARunErrorAndLeavesNothing) {
    // Limits from less than one frame of noise up to one that is only exceeded when the file is closed.
    for (const char* name : {"new/a.mp4", "new/a.mov", "new/a.mkv", "new/a.webm", "new/frames/"}) {
        const TemporaryFolder folder;
        for (rlim_t limit : {10u, 1000u, 6000u}) {
            std::string message;
            {
                const FileSizeLimit full(limit);
                try {
                    VideoWriter writer(folder / name, options());
                    for (unsigned n = 0; n < 30; ++n) writer.append(noise(kWidth, kHeight, n));
                    writer.finish();
                } catch (const RunError& error) {
                    message = error.what();
                }
            }
            EXPECT_NE(message.find("cannot be written: File too large"), std::string::npos)
                << name << ", limit " << limit << ": " << message;
            EXPECT_EQ(folder.listing(), Names{}) << name;
        }
    }
}

TEST(VideoWriter, WriteThatFailsWhileTheIndexMovesToTheFrontLeavesNothing) {
    const TemporaryFolder folder;
    write_numbered(folder / "whole.mp4", 30);
    const auto whole = static_cast<rlim_t>(std::filesystem::file_size(folder / "whole.mp4"));
    std::string message;
    {
        const FileSizeLimit full(whole - 1);
        try {
            write_numbered(folder / "a.mp4", 30);
        } catch (const RunError& error) {
            message = error.what();
        }
    }
    EXPECT_EQ(message, (folder / "a.mp4").string() + ": cannot be written: File too large");
    EXPECT_EQ(folder.listing(), Names{"whole.mp4"});
}

TEST(VideoWriter, NeedsAtLeastOneFrame) {
    const TemporaryFolder folder;
    {
        VideoWriter writer(folder / "a.mp4", options());
        EXPECT_THROW(writer.finish(), RunError);
    }
    EXPECT_EQ(folder.listing(), Names{});
}

TEST(VideoWriter, RefusesAFrameOfAnotherSize) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "a.mkv", options());
    writer.append(numbered_frame(0));
    try {
        writer.append(noise(32, 32, 0));
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_EQ(error.what(),
                  (folder / "a.mkv").string() + ": frame 1 is 32 x 32 pixels, the video 64 x 48");
    }
}

TEST(VideoWriter, Mp4RefusesTransparencyRatherThanLoseIt) {
    const TemporaryFolder folder;
    VideoWriter writer(folder / "a.mp4", options());
    try {
        writer.append(noise(kWidth, kHeight, 0, /*opaque=*/false));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(),
                  (folder / "a.mp4").string() +
                      ": expected opaque frames (.mkv, .mov, .webm and PNG frames keep "
                      "transparency, .mp4 cannot), found transparent pixels in frame 0");
    }
}

TEST(VideoTarget, OfAnotherEndingListsTheOnesThereAre) {
    const std::string expected =
        ": expected an ending of .mp4 or .mov (H.264), .mkv (lossless), .webm (VP9) or / (a folder "
        "of PNG frames), found ";
    EXPECT_EQ(message_of("a.avi", options()), "a.avi" + expected + "\".avi\"");
    EXPECT_EQ(message_of("out/smile", options()), "out/smile" + expected + "no ending");
    EXPECT_EQ(message_of("", options()), expected + "no ending");
    EXPECT_EQ(message_of("A.MP4", options()), "no error");
    EXPECT_EQ(message_of("frames/", options()), "no error");
}

TEST(VideoTarget, FolderWithoutANameIsRefused) {
    EXPECT_EQ(message_of("./", options()),
              "./: expected a folder with a name of its own, such as frames/, found \"./\"");
    EXPECT_EQ(message_of("a/../", options()),
              "a/../: expected a folder with a name of its own, such as frames/, found \"a/../\"");
}

TEST(VideoTarget, OfOddSizeIsRefusedForMp4Only) {
    const VideoOptions odd{.width_px = 641, .height_px = 480};
    EXPECT_EQ(
        message_of("a.mp4", odd),
        "a.mp4: expected an even width and height for .mp4 (its colour is stored at half size), "
        "found 641 x 480");
    EXPECT_EQ(message_of("a.mkv", odd), "no error");
    EXPECT_EQ(message_of("a/", odd), "no error");
}

TEST(VideoTarget, OptionsOutOfRangeAreNamed) {
    EXPECT_EQ(message_of("a.mp4", {.width_px = 0, .height_px = 480}),
              "a.mp4: expected a width in pixels in [16, 8192], found 0");
    EXPECT_EQ(message_of("a.mkv", {.width_px = 640, .height_px = 20000}),
              "a.mkv: expected a height in pixels in [2, 16384], found 20000");
    EXPECT_EQ(message_of("a.mp4", {.width_px = 640, .height_px = 480, .fps = 0}),
              "a.mp4: expected frames per second in [1, 1000], found 0");
    EXPECT_EQ(message_of("a.mp4", {.width_px = 640, .height_px = 480, .crf = 52}),
              "a.mp4: expected a quality (crf) in [0, 51], found 52");
    EXPECT_EQ(
        message_of("a.mp4", {.width_px = 640, .height_px = 480, .preset = "quick"}),
        "a.mp4: expected an encoder preset, one of ultrafast superfast veryfast faster fast medium "
        "slow slower veryslow placebo, found \"quick\"");
}

TEST(VideoTarget, FolderWithForeignFilesIsLeftAlone) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "thesis");
    std::ofstream(folder / "thesis/chapter1.tex") << "years of work";
    const std::string target = (folder / "thesis").string() + "/";
    EXPECT_EQ(
        message_of(target, options()),
        target +
            ": expected an empty folder or one that holds only frame_000000.png and so on, found "
            "\"chapter1.tex\" in it");
    EXPECT_THROW(VideoWriter(target, options()), Error);
    EXPECT_EQ(folder.listing(), (Names{"thesis", "thesis/chapter1.tex"}));
}

TEST(VideoTarget, FolderAndFileAreNotMixedUp) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a.mp4");
    EXPECT_EQ(message_of(folder / "a.mp4", options()),
              (folder / "a.mp4").string() +
                  ": expected a file (end it with / for a folder of PNG frames), found a folder");
    std::ofstream(folder / "file") << "x";
    const std::string target = (folder / "file").string() + "/";
    EXPECT_EQ(message_of(target, options()), target + ": expected a folder, found a file");
    try {
        VideoWriter(folder / "file/a.mp4", options());
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), (folder / "file").string() + ": expected a folder, found a file");
    }
}

TEST(VideoReader, NamesWhatIsWrongWithAFile) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) -> std::string {
        try {
            VideoReader video(folder / name);
        } catch (const Error& error) {
            const std::string what = error.what();
            return what.substr(folder.path().string().size() + 1);
        }
        return "no error";
    };
    EXPECT_EQ(message("a.mp4"), "a.mp4: expected a video file, found no such file");
    std::ofstream(folder / "text.mp4") << "not a video";
    EXPECT_EQ(message("text.mp4"),
              "text.mp4: expected a video file, found another kind of file, or one cut short");
}

TEST(VideoReader, RefusesAFileCutShort) {
    const TemporaryFolder folder;
    for (const std::string ending : {".mp4", ".mov", ".mkv", ".webm"}) {
        VideoWriter writer(folder / ("whole" + ending), options());
        for (unsigned n = 0; n < 10; ++n) writer.append(noise(kWidth, kHeight, n));
        writer.finish();
        const std::string whole = bytes_of(folder / ("whole" + ending));
        EXPECT_EQ(VideoReader(folder / ("whole" + ending)).frames(), 10);
        for (double part : {0.02, 0.3, 0.6, 0.9}) {
            const auto length = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
            std::ofstream(folder / ("cut" + ending), std::ios::binary) << whole.substr(0, length);
            EXPECT_THROW(VideoReader(folder / ("cut" + ending)), Error) << ending << " " << part;
        }
    }
}

}  // namespace
}  // namespace risorius::media
