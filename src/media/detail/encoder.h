// One video stream into one file: H.264 in MP4 or FFV1 in Matroska. Knows nothing of temporary
// names.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.h"
#include "media/video_writer.h"

namespace risorius::media::detail {

enum class Container { kMp4, kMatroska };

class Encoder {
  public:
    /// `name` stands in messages, since `file` is a temporary name. `alpha` is for Matroska only.
    Encoder(const std::filesystem::path& file, std::string name, Container container,
            const VideoOptions& options, bool alpha);
    ~Encoder();
    void append(const Image& frame);
    void finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media::detail
