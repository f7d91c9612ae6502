// SPDX-License-Identifier: MIT
/// \file
/// Writes sound to a WAV file: 16-bit or 24-bit integers, or 32-bit floating point.
#pragma once

#include <filesystem>

#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// Writes a file with the sound's own rate, channels and bits. Integers are clipped at full scale. The file is written under a
/// temporary name and then renamed. Throws RunError on failure.
void write_wav(const Sound& sound, const std::filesystem::path& file);

}  // namespace risorius::media
