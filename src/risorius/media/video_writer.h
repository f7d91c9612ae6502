// SPDX-License-Identifier: MIT
/// \file
/// Writes frames to a video through the FFmpeg libraries, at a constant frame rate. Frame n is at n / fps.
///
///   .mp4    H.264; lossless: H.264 in RGB            AAC
///   .mov    H.264; lossless: H.264 in RGB            PCM     with transparency ProRes 4444; lossless: PNG
///   .mkv    FFV1, always lossless, 8 or 16 bits      PCM     transparency too
///   .webm   VP9; lossless: VP9 in RGB                Opus    transparency too, not lossless
///   frames/ PNG, 8 or 16 bits                        none    transparency too
///
/// Colour: the sRGB-encoded values become R'G'B' of BT.709 unchanged, as players assume. Matroska and WebM round times to a
/// millisecond.
///
/// A target below the private folder of an OutputSet is written straight away, and the set decides about it. Any other is a set
/// of its own, which finish() commits. A writer that is abandoned leaves nothing.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "risorius/core/image.h"
#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// Options that are not given have the usual value. Options that the target's format does not support are errors.
struct VideoOptions {
    int width_px = 0;  ///< must be even where colour is stored at half size: yuv420p
    int height_px = 0;
    int fps = 60;
    /// Quality, lower is better: H.264 0..51, default 18; VP9 0..63, default 24.
    std::optional<int> crf = {};
    /// Preset of H.264: slower ones make smaller files; none: "faster" with subme=2.
    std::optional<std::string> preset = {};
    std::optional<std::string> pixels = {};     ///< "yuv420p", or "yuv444p": colour at full size
    std::optional<int> keyframe_interval = {};  ///< in frames; default: a quarter of a second
    bool lossless = false;
    /// All frames are the same picture. In H.264 every frame then decodes to the same bytes as the first one.
    bool still = false;
    /// H.264 only: every frame leaves the encoder before the next one comes in.
    bool live = false;
    std::optional<int> bits = {};  ///< per channel of PNG frames and in .mkv, 8 or 16; default: 8
    bool alpha = false;            ///< frames may be transparent even if the first one is not
    /// The sound of the video. It is cut, or extended with silence, to the length of the video.
    std::shared_ptr<const Recording> sound = {};
    /// Number of samples from the first frame to the first sample, at the sound's own rate.
    std::int64_t sound_offset_samples = 0;
};

/// Throws Error when the ending is none of these, or when size or options do not fit the format.
void check_target(const std::filesystem::path& target, const VideoOptions& options);

/// A video that is being written. All frames must have the size of the options.
class VideoWriter {
  public:
    VideoWriter(const std::filesystem::path& target, const VideoOptions& options);
    ~VideoWriter();  ///< without finish(), it removes what was written
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    void append(const Image& frame);  ///< throws RunError, for instance when the disk is full
    void finish();                    ///< flushes and closes; throws RunError
    int frames() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
