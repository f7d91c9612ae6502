// SPDX-License-Identifier: MIT
/// \file
/// Writes sound to a WAV file: integers of 16 or 24 bits, or floating point of 32.
#pragma once

#include <filesystem>

#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// Uses the sound's own rate, channels and bits; integers are clipped at full scale. Written under another name first and then renamed.
/// Throws RunError on failure.
void write_wav(const Sound& sound, const std::filesystem::path& file);

}  // namespace risorius::media
