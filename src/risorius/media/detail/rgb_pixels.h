// SPDX-License-Identifier: MIT
/// \file
/// Lossless conversion between pictures and the pixels of RGB frames with 8 or 16 bits per channel, packed or planar.
#pragma once

#include "risorius/core/image.h"
#include "risorius/media/detail/ffmpeg.h"

namespace risorius::media::detail {

/// Returns whether a pixel format is one of RGB frames with 8 or with 16 bits in the byte order of this machine.
bool is_rgb_of_whole_bytes(AVPixelFormat format);
/// Frames of 16 bits get Image::deep, or its bytes times 257 when it has none.
void put_rgb_pixels(const Image& image, AVFrame& frame);
/// Returns an opaque picture when the frame has no alpha. Of 16 bits, it also has Image::deep.
Image rgb_pixels_of(const AVFrame& frame);

}  // namespace risorius::media::detail
