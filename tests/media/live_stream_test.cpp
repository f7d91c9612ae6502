// SPDX-License-Identifier: MIT
// What reaches a pipe while a film is made. The writer goes to standard output, so it is run in a child of this process.
#include "risorius/media/live_stream.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "media/pictures.h"
#include "risorius/core/error.h"
#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/video_reader.h"
#include "temporary_folder.h"

namespace risorius::media {
namespace {

constexpr int kLiveFrames = 7, kLiveRate_hz = 22050;
constexpr LiveStreamOptions kLive{
    .width_px = kWidth, .height_px = kHeight, .fps = 60, .sound_rate_hz = kLiveRate_hz};

float heard(std::int64_t sample) {
    return static_cast<float>(std::lround(8000 * std::sin(0.1 * static_cast<double>(sample)))) /
           32768.0F;
}

/// A film is written to `to` by a child, which waits for a byte from `go` before each picture.
::pid_t write_film(int go, int to) {
    const ::pid_t child = ::fork();
    if (child != 0) return child;
    int failed = 1;
    try {
        ::dup2(to, STDOUT_FILENO);
        LiveStream stream("film", kLive);
        char byte = 0;
        for (int n = 0; n < kLiveFrames && ::read(go, &byte, 1) == 1; ++n) {
            std::vector<float> sound;
            for (std::int64_t i = stream.first_sample(n); i < stream.first_sample(n + 1); ++i)
                sound.push_back(heard(i));
            stream.append(flat(kWidth, kHeight, 20 + 30 * n, 20 + 30 * n, 20 + 30 * n), sound);
        }
        stream.finish();
        failed = 0;
    } catch (...) {
    }
    ::_exit(failed);
}

/// Pictures in the begin of a film; VideoReader wants whole ones.
int pictures_in(const std::filesystem::path& file) {
    AVFormatContext* format = nullptr;
    if (avformat_open_input(&format, detail::ffmpeg_url(file.string()).c_str(), nullptr, nullptr) <
        0)
        return 0;
    const detail::PacketPtr packet(av_packet_alloc());
    int count = 0;
    for (; av_read_frame(format, packet.get()) >= 0; av_packet_unref(packet.get()))
        if (packet->stream_index == 0) ++count;
    avformat_close_input(&format);
    return count;
}

TEST(LiveStream, APictureLeavesBeforeTheNextOneComesAndTheFilmIsWhole) {
    int go[2], film[2];
    ASSERT_EQ(::pipe(go), 0);
    ASSERT_EQ(::pipe(film), 0);
    const ::pid_t child = write_film(go[0], film[1]);
    ASSERT_GT(child, 0);
    ::close(go[0]);
    ::close(film[1]);
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "film.mkv";
    std::string bytes;
    std::array<char, 4096> block{};
    const auto read_some = [&] {
        const ::ssize_t got = ::read(film[0], block.data(), block.size());
        if (got > 0) bytes.append(block.data(), static_cast<std::size_t>(got));
        return got > 0;
    };
    const auto pictures = [&] {
        std::ofstream(file, std::ios::binary) << bytes;
        return pictures_in(file);
    };
    // The child waits for the next byte. A picture that it keeps until then never comes.
    for (int n = 0; n < kLiveFrames; ++n) {
        ASSERT_EQ(::write(go[1], "x", 1), 1);
        while (pictures() <= n) ASSERT_TRUE(read_some());
    }
    ::close(go[1]);
    while (read_some()) {
    }
    ::close(film[0]);
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);

    EXPECT_EQ(pictures(), kLiveFrames);
    VideoReader reader(file);
    ASSERT_EQ(reader.frames(), kLiveFrames);
    for (int n = 0; n < kLiveFrames; ++n) {
        EXPECT_NEAR(reader.time_s(n), n / 60.0, 0.001);
        EXPECT_NEAR(reader.frame(n).pixel(kWidth / 2, kHeight / 2)[1], 20 + 30 * n, 3) << n;
    }
    const Sound sound = read_sound(file);
    EXPECT_EQ(sound.rate_hz, kLiveRate_hz);
    ASSERT_EQ(sound.length(), std::int64_t{kLiveFrames} * kLiveRate_hz / 60);
    for (std::int64_t i = 0; i < sound.length(); ++i)
        ASSERT_EQ(sound.samples[static_cast<std::size_t>(i)], heard(i)) << i;
}

TEST(LiveStream, AnOddSizeIsRefused) {
    LiveStreamOptions odd = kLive;
    odd.width_px = 65;
    EXPECT_THROW(LiveStream("film", odd), Error);
}

}  // namespace
}  // namespace risorius::media
