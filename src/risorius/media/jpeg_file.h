// SPDX-License-Identifier: MIT
/// \file
/// Writes pictures as JPEG through the FFmpeg libraries.
#pragma once

#include <string>

#include "risorius/core/image.h"

namespace risorius::media {

/// Returns the bytes of a JPEG file (JFIF, baseline, colours at half the resolution of brightness, which every reader knows) without alpha. `quantizer`: 1 is finest, 31
/// coarsest; at 2 a picture of skin is a fifth of its PNG. The bytes depend only on the picture. Throws Error for a picture without
/// pixels. `name`: of the picture, for messages.
std::string jpeg_bytes(const Image& image, const std::string& name, int quantizer = 2);

}  // namespace risorius::media
