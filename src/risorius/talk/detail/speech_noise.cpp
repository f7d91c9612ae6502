// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/speech_noise.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/counter_rng.h"

namespace risorius::talk {

namespace {

constexpr std::size_t kPoles = 24;
constexpr double kWhite = 1e-4;        // part of white noise that keeps the filter stable
constexpr std::size_t kWarmUp = 4000;  // samples until the filter has forgotten its beginning
constexpr double kLoudest = 0.98;
constexpr int kUniforms = 12;  // their sum is nearly Gaussian, with variance 1

/// The sound without its pauses.
std::vector<double> spoken_part(const std::vector<float>& sound,
                                const speech::Utterance& utterance) {
    std::vector<double> out;
    for (const speech::Phone& phone : utterance.phones) {
        if (phone.is_pause()) continue;
        const auto end = std::min<std::int64_t>(phone.end, static_cast<std::int64_t>(sound.size()));
        for (std::int64_t i = std::max<std::int64_t>(0, phone.start); i < end; ++i)
            out.push_back(sound[static_cast<std::size_t>(i)]);
    }
    return out;
}

double rms(const std::vector<double>& x) {
    double sum = 0;
    for (const double v : x) sum += v * v;
    return x.empty() ? 0 : std::sqrt(sum / static_cast<double>(x.size()));
}

/// Coefficients a of x[n] + sum a_k x[n - k] = e[n], by the recursion of Levinson and Durbin.
std::vector<double> predictor(const std::vector<double>& x) {
    std::vector<double> r(kPoles + 1, 0.0), a(kPoles, 0.0);
    for (std::size_t lag = 0; lag <= kPoles; ++lag)
        for (std::size_t i = lag; i < x.size(); ++i) r[lag] += x[i] * x[i - lag];
    r[0] *= 1 + kWhite;
    double error = r[0];
    for (std::size_t m = 0; m < kPoles && error > 0; ++m) {
        double sum = r[m + 1];
        for (std::size_t k = 0; k < m; ++k) sum += a[k] * r[m - k];
        const double reflection = -sum / error;
        std::vector<double> next = a;
        next[m] = reflection;
        for (std::size_t k = 0; k < m; ++k) next[k] += reflection * a[m - 1 - k];
        a = std::move(next);
        error *= 1 - reflection * reflection;
    }
    return a;
}

}  // namespace

NoisySpeech with_noise(const std::vector<float>& sound, const speech::Utterance& utterance,
                       double snr_db, std::uint64_t seed) {
    const std::vector<double> spoken = spoken_part(sound, utterance);
    const std::vector<double> a = predictor(spoken);
    NoisySpeech out;
    out.before = std::llround(kNoiseAround_s * utterance.rate_hz);
    const std::size_t count = sound.size() + 2 * static_cast<std::size_t>(out.before);
    RandomSequence random(seed);
    std::vector<double> noise(kWarmUp + count);
    for (std::size_t n = 0; n < noise.size(); ++n) {
        double white = -kUniforms / 2.0;
        for (int k = 0; k < kUniforms; ++k) white += random.next();
        for (std::size_t k = 0; k < kPoles && k < n; ++k) white -= a[k] * noise[n - 1 - k];
        noise[n] = white;
    }
    noise.erase(noise.begin(), noise.begin() + kWarmUp);
    const double level = rms(spoken) * std::pow(10.0, -snr_db / 20) / std::max(rms(noise), 1e-30);
    const double ramp = std::max(1.0, kNoiseRamp_s * utterance.rate_hz);
    double loudest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double edge = std::min(1.0, static_cast<double>(std::min(i, count - 1 - i)) / ramp);
        noise[i] *= level * edge * edge * (3 - 2 * edge);
        if (i >= static_cast<std::size_t>(out.before) &&
            i - static_cast<std::size_t>(out.before) < sound.size())
            noise[i] += sound[i - static_cast<std::size_t>(out.before)];
        loudest = std::max(loudest, std::abs(noise[i]));
    }
    if (loudest > kLoudest) out.gain = kLoudest / loudest;
    for (const double v : noise) out.samples.push_back(static_cast<float>(out.gain * v));
    return out;
}

}  // namespace risorius::talk
