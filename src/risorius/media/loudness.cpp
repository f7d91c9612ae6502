// SPDX-License-Identifier: MIT
#include "risorius/media/loudness.h"

#include <ebur128.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "risorius/core/error.h"

namespace risorius::media {

namespace {

struct Destroy {
    void operator()(ebur128_state* state) const { ebur128_destroy(&state); }
};

void check_ebur128(int code) {
    if (code != EBUR128_SUCCESS)
        throw RunError("the loudness of the sound cannot be measured (libebur128 says " +
                       std::to_string(code) + ")");
}

}  // namespace

Loudness loudness_of(const Sound& sound) {
    const std::unique_ptr<ebur128_state, Destroy> state(ebur128_init(
        static_cast<unsigned>(sound.channels), static_cast<unsigned long>(sound.rate_hz),
        EBUR128_MODE_I | EBUR128_MODE_TRUE_PEAK));
    if (!state)
        throw RunError("the loudness of a sound of " + std::to_string(sound.channels) +
                       " channels at " + std::to_string(sound.rate_hz) + " Hz is not defined");
    check_ebur128(ebur128_add_frames_float(state.get(), sound.samples.data(),
                                           static_cast<std::size_t>(sound.length())));
    Loudness out;
    check_ebur128(ebur128_loudness_global(state.get(), &out.integrated_lufs));
    double peak = 0;
    for (int channel = 0; channel < sound.channels; ++channel) {
        double of_channel = 0;
        check_ebur128(ebur128_true_peak(state.get(), static_cast<unsigned>(channel), &of_channel));
        peak = std::max(peak, of_channel);
    }
    out.true_peak_dbtp =
        peak > 0 ? 20 * std::log10(peak) : -std::numeric_limits<double>::infinity();
    return out;
}

Sound heard(const Sound& sound, std::int64_t offset, std::int64_t length) {
    Sound out = sound;
    out.samples.assign(static_cast<std::size_t>(length * sound.channels), 0.0f);
    const std::int64_t begin = std::max<std::int64_t>(0, offset),
                       end = std::min(length, offset + sound.length());
    for (std::int64_t i = begin * sound.channels; i < end * sound.channels; ++i)
        out.samples[static_cast<std::size_t>(i)] =
            sound.samples[static_cast<std::size_t>(i - offset * sound.channels)];
    return out;
}

Sound amplified(Sound sound, double gain_db) {
    const double factor = std::pow(10, gain_db / 20);
    for (float& sample : sound.samples) sample = static_cast<float>(factor * sample);
    return sound;
}

}  // namespace risorius::media
