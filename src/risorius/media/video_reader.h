// SPDX-License-Identifier: MIT
/// \file
/// Reads frames of a video file through the FFmpeg libraries: their number, size and times, and the pixels of any frame.
#pragma once

#include <filesystem>
#include <memory>

#include "risorius/core/image.h"

namespace risorius::media {

/// An open video file.
class VideoReader {
  public:
    /// Reads the index of the whole file. Throws Error when the file is missing, not a video, or incomplete.
    explicit VideoReader(const std::filesystem::path& file);
    ~VideoReader();
    VideoReader(const VideoReader&) = delete;
    VideoReader& operator=(const VideoReader&) = delete;

    int frames() const;
    int width_px() const;
    int height_px() const;
    double fps() const;

    /// Returns the time, s, at which a frame is shown, as it is stored; Matroska rounds it to a millisecond. `frame` is in [0,
    /// frames()).
    double time_s(int frame) const;

    /// Returns the pixels of a frame; of RGB with 16 bits also as Image::deep. YUV is converted with the matrix and range that the file names. Reading frames in ascending
    /// order is fastest.
    Image frame(int frame);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
