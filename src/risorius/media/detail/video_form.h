// SPDX-License-Identifier: MIT
/// \file
/// The container and the coding of pictures, as the ending of a file name determines them.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/media/video_writer.h"

namespace risorius::media::detail {

enum class Form { kMp4, kMov, kMatroska, kWebm, kFolder };

/// Throws Error for an ending that is none of these.
Form form_of(const std::filesystem::path& target);

enum class Coding {
    kH264,     ///< 8 bits, yuv420p or yuv444p
    kH264Rgb,  ///< lossless
    kProRes,   ///< 4444 with alpha, 10 bits of colour
    kPng,      ///< lossless with alpha
    kFfv1,     ///< lossless, with alpha or without
    kVp9,      ///< 8 bits, yuv420p or yuv444p; alpha is stored beside yuv420p
    kVp9Rgb,   ///< lossless
};

/// Returns the coding of pictures. `form` must not be kFolder.
Coding coding_of(Form form, const VideoOptions& options, bool alpha);

/// Returns whether colour has half the resolution of brightness.
bool halves_colour(Coding coding, const VideoOptions& options);

/// Throws Error for options that the form does not support.
void check_options(const std::string& place, Form form, const VideoOptions& options);

}  // namespace risorius::media::detail
