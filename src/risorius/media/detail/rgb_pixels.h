// SPDX-License-Identifier: MIT
/// \file
/// Lossless conversion between pictures and the pixels of 8-bit RGB frames, packed or planar.
#pragma once

#include "risorius/core/image.h"
#include "risorius/media/detail/ffmpeg.h"

namespace risorius::media::detail {

/// Returns whether a pixel format is one of 8-bit RGB frames.
bool is_rgb_of_bytes(AVPixelFormat format);
void put_rgb_pixels(const Image& image, AVFrame& frame);
Image rgb_pixels_of(const AVFrame& frame);  ///< opaque when the frame has no alpha

}  // namespace risorius::media::detail
