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

class Meter {
  public:
    explicit Meter(const SoundForm& form)
        : channels_(form.channels),
          state_(ebur128_init(static_cast<unsigned>(form.channels),
                              static_cast<unsigned long>(form.rate_hz),
                              EBUR128_MODE_I | EBUR128_MODE_TRUE_PEAK)) {
        if (!state_)
            throw RunError("the loudness of a sound of " + std::to_string(form.channels) +
                           " channels at " + std::to_string(form.rate_hz) + " Hz is not defined");
    }
    void add(const float* samples, std::size_t count) {
        check_ebur128(ebur128_add_frames_float(state_.get(), samples, count));
    }
    Loudness result() const {
        Loudness out;
        check_ebur128(ebur128_loudness_global(state_.get(), &out.integrated_lufs));
        double peak = 0;
        for (int channel = 0; channel < channels_; ++channel) {
            double of_channel = 0;
            check_ebur128(
                ebur128_true_peak(state_.get(), static_cast<unsigned>(channel), &of_channel));
            peak = std::max(peak, of_channel);
        }
        out.true_peak_dbtp =
            peak > 0 ? 20 * std::log10(peak) : -std::numeric_limits<double>::infinity();
        return out;
    }

  private:
    int channels_;
    std::unique_ptr<ebur128_state, Destroy> state_;
};

}  // namespace

Loudness loudness_of(const Sound& sound) {
    Meter meter(sound);
    meter.add(sound.samples.data(), static_cast<std::size_t>(sound.length()));
    return meter.result();
}

Loudness loudness_of(const Recording& recording, std::int64_t offset, std::int64_t length) {
    Meter meter(recording);
    for_each_piece(recording, offset, length,
                   [&](const float* samples, std::size_t count) { meter.add(samples, count); });
    return meter.result();
}

}  // namespace risorius::media
