// SPDX-License-Identifier: MIT
#include "risorius/media/wav_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "risorius/core/output_set.h"

namespace risorius::media {

void write_wav(const Sound& sound, const std::filesystem::path& file) {
    const int bytes = sound.bits / 8;
    const bool floating = sound.bits == 32;
    std::string out;
    const auto put = [&](std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 255));
    };
    const std::size_t data = sound.samples.size() * static_cast<std::size_t>(bytes);
    out += "RIFF";
    put(36 + data + data % 2, 4);
    out += "WAVEfmt ";
    put(16, 4);
    put(floating ? 3 : 1, 2);  // WAVE_FORMAT_IEEE_FLOAT, WAVE_FORMAT_PCM
    put(static_cast<std::uint64_t>(sound.channels), 2);
    put(static_cast<std::uint64_t>(sound.rate_hz), 4);
    put(static_cast<std::uint64_t>(sound.rate_hz) *
            static_cast<std::uint64_t>(sound.channels * bytes),
        4);
    put(static_cast<std::uint64_t>(sound.channels * bytes), 2);
    put(static_cast<std::uint64_t>(sound.bits), 2);
    out += "data";
    put(data, 4);
    const double full = std::ldexp(1.0, sound.bits - 1);
    for (const float sample : sound.samples) {
        if (floating) {
            std::uint32_t same = 0;
            std::memcpy(&same, &sample, sizeof same);
            put(same, 4);
        } else {
            put(static_cast<std::uint64_t>(
                    std::llround(std::clamp(static_cast<double>(sample) * full, -full, full - 1))),
                bytes);
        }
    }
    if (data % 2 != 0) out.push_back(0);
    write_file(file, out);
}

}  // namespace risorius::media
