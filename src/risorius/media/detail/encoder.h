// SPDX-License-Identifier: MIT
/// \file
/// Encodes pictures and their sound to one file. It does not handle temporary names.
///
/// The container is bitexact: it has no dates, library versions or random identifiers. Matroska stores times rounded to whole
/// milliseconds; the exact frame period is in its DefaultDuration.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "risorius/core/image.h"
#include "risorius/media/detail/video_form.h"

namespace risorius::media::detail {

class Encoder {
  public:
    /// `name` is used in messages, since `file` is a temporary name. `form` must not be kFolder.
    Encoder(const std::filesystem::path& file, std::string name, Form form,
            const VideoOptions& options, bool alpha);
    ~Encoder();
    void append(const Image& frame);
    void finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media::detail
