// Sound to a WAV file: integers of 16 or 24 bits, or floating point of 32.
#pragma once

#include <filesystem>

#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// In the sound's own rate, channels and bits; what is beyond full scale is cut off, but for floating point. Written beside and
/// renamed, never half. Throws RunError when it cannot be written.
void write_wav(const Sound& sound, const std::filesystem::path& file);

}  // namespace risorius::media
