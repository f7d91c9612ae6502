// Frames to video through the FFmpeg libraries: MP4 (H.264, yuv420p, BT.709, faststart) and lossless Matroska (FFV1),
// or a folder of PNG frames; constant frame rate, frame n at n / fps.
//
// Colour: the sRGB-encoded values become R'G'B' of BT.709 unchanged, as players assume. Transparency is kept by PNG
// frames and, when the first frame has any, by Matroska; MP4 refuses it. Matroska rounds times to a millisecond.
//
// Everything is written under a temporary name beside the target and renamed by finish(); an abandoned writer leaves nothing.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/image.h"

namespace risorius::media {

struct VideoOptions {
    int width_px = 0;  ///< even for MP4
    int height_px = 0;
    int fps = 60;
    int crf = 18;  ///< H.264 quality, 0 (lossless) .. 51
    std::string preset = "medium";
};

/// Throws Error when the ending is not .mp4, .mkv or a folder ("frames/"), or the size does not fit the format.
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
