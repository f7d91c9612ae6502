// SPDX-License-Identifier: MIT
/// \file
/// Reads frames of a video file through the FFmpeg libraries: their number, size, times, and the pixels of any frame.
#pragma once

#include <filesystem>
#include <memory>

#include "risorius/core/image.h"

namespace risorius::media {

class VideoReader {
  public:
    /// Reads the index of the whole file. Throws Error when it is missing, no video, or cut short.
    explicit VideoReader(const std::filesystem::path& file);
    ~VideoReader();
    VideoReader(const VideoReader&) = delete;
    VideoReader& operator=(const VideoReader&) = delete;

    int frames() const;
    int width_px() const;
    int height_px() const;
    double fps() const;

    /// When a frame is shown, s; as stored, so Matroska's are rounded to a millisecond. Frame in
    /// [0, frames()).
    double time_s(int frame) const;

    /// A frame's pixels; YUV is converted by the matrix and range the file names. Fastest in
    /// ascending order.
    Image frame(int frame);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
