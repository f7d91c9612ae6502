// SPDX-License-Identifier: MIT
/// \file
/// Frames to video through the FFmpeg libraries, constant frame rate, frame n at n / fps:
///
///   .mp4    H.264; lossless: H.264 in RGB            AAC
///   .mov    H.264; lossless: H.264 in RGB            PCM     with transparency ProRes 4444; lossless: PNG
///   .mkv    FFV1, always lossless                    PCM     transparency too
///   .webm   VP9; lossless: VP9 in RGB                Opus    transparency too, not lossless
///   frames/ PNG, 8 or 16 bits                        none    transparency too
///
/// Colour: the sRGB-encoded values become R'G'B' of BT.709 unchanged, as players assume. Matroska and WebM round times to a
/// millisecond.
///
/// Everything is written under a temporary name beside the target and renamed by finish(); an abandoned writer leaves nothing.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "risorius/core/image.h"
#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// Options that are not given have the usual value. Options that the target's format does not have are an error.
struct VideoOptions {
    int width_px = 0;  ///< even where colour is stored at half size: yuv420p
    int height_px = 0;
    int fps = 60;
    std::optional<int> crf = {};  ///< quality: H.264 0..51, 18; VP9 0..63, 24; less is better
    std::optional<std::string> preset =
        {};  ///< of H.264: slower ones make smaller files; none: "faster" with subme=2
    std::optional<std::string> pixels = {};     ///< "yuv420p", or "yuv444p": colour at full size
    std::optional<int> keyframe_interval = {};  ///< frames, a quarter of a second
    bool lossless = false;
    std::optional<int> bits = {};  ///< of PNG frames, 8 or 16
    bool alpha = false;            ///< frames may be transparent though the first is not
    std::shared_ptr<const Sound> sound =
        {};  ///< cut or filled up with silence to the length of the video
    std::int64_t sound_offset_samples =
        0;  ///< from the first frame to its first sample; of its rate
};

/// Throws Error when the ending is none of these, or size and options do not fit the format.
void check_target(const std::filesystem::path& target, const VideoOptions& options);

class VideoWriter {
  public:
    VideoWriter(const std::filesystem::path& target, const VideoOptions& options);
    ~VideoWriter();  ///< without finish(): removes what was written
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    void append(const Image& frame);  ///< throws RunError (disk full, encoder)
    void finish();                    ///< flushes, closes, renames; throws RunError
    int frames() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
