// SPDX-License-Identifier: MIT
#include "risorius/media/mono_sound.h"

#include <string>

#include "risorius/core/error.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/wav_file.h"

namespace risorius::media {

int sound_rate_hz(const std::filesystem::path& file) { return open_recording(file).rate_hz; }

MonoSound read_mono_sound(const std::filesystem::path& file, std::int64_t most) {
    const Recording recording = open_recording(file);
    if (recording.length() > most)
        throw Error(file.string(), "at most " + std::to_string(most) + " samples in each channel",
                    std::to_string(recording.length()));
    MonoSound out;
    out.rate_hz = recording.rate_hz;
    out.samples.reserve(static_cast<std::size_t>(recording.length()));
    const auto channels = static_cast<std::size_t>(recording.channels);
    for_each_piece(recording, 0, recording.length(), [&](const float* samples, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            float sum = 0;
            for (std::size_t c = 0; c < channels; ++c) sum += samples[i * channels + c];
            out.samples.push_back(sum / static_cast<float>(channels));
        }
    });
    return out;
}

void write_mono_wav(const MonoSound& sound, const std::filesystem::path& file) {
    Sound out;
    out.rate_hz = sound.rate_hz;
    out.channels = 1;
    out.bits = 16;
    out.samples = sound.samples;
    write_wav(out, file);
}

}  // namespace risorius::media
