// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/align/mel_cepstra.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <numbers>

namespace risorius::speech {

namespace {

constexpr double kLongFrame_s = 0.025, kShortFrame_s = 0.010;
constexpr int kBands = 26, kShortBands = 20, kCepstra = 13;
constexpr double kLowest_hz = 100, kHighest_hz = 7000;
constexpr double kPreEmphasis = 0.97;
// What is softer than this below the loudest band of a sound counts as this much.
constexpr double kFloor_db = 55;
// The energy tells speech from silence, but it differs between speakers and microphones.
constexpr float kEnergyWeight = 0.35F, kDeltaWeight = 0.7F;
// Cepstra of a higher order tell less about the sound and more about the speaker: the last one counts exp(-3) of the first.
constexpr float kOrderLoss = 3.0F / 12;
// Silence: 6 dB above the softest frames, but between these distances from the loudest ones
constexpr double kAboveFloor_db = 6, kSilentBelow_db = 40, kSilentAbove_db = 14;
constexpr double kPauseLength_s = 0.2;

double mel_of(double hz) { return 1127 * std::log1p(hz / 700); }
double hz_of(double mel) { return 700 * std::expm1(mel / 1127); }

/// Power spectra of pieces of sound, summed into bands.
class BandFilter {
  public:
    BandFilter(int rate_hz, double frame_s, int bands, double top_hz)
        : length_(std::max(8L, std::lround(frame_s * rate_hz))) {
        while (size_ < length_) size_ *= 2;
        window_.resize(static_cast<std::size_t>(length_));
        for (long i = 0; i < length_; ++i)
            window_[static_cast<std::size_t>(i)] =
                0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                     static_cast<double>(length_));
        for (long i = 0; i < size_ / 2; ++i)
            turns_.push_back(std::polar(
                1.0, -2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size_)));
        weights_ = Eigen::MatrixXd::Zero(bands, size_ / 2 + 1);
        const double low = mel_of(kLowest_hz), step = (mel_of(top_hz) - low) / (bands + 1);
        for (int b = 0; b < bands; ++b) {
            const double from = hz_of(low + b * step), middle = hz_of(low + (b + 1) * step),
                         to = hz_of(low + (b + 2) * step);
            for (long k = 0; k <= size_ / 2; ++k) {
                const double hz = static_cast<double>(k) * rate_hz / static_cast<double>(size_);
                weights_(b, k) = std::max(
                    0.0, std::min((hz - from) / (middle - from), (to - hz) / (to - middle)));
            }
            // A band that is narrower than the spacing of the spectrum takes the nearest line.
            if (weights_.row(b).sum() <= 0)
                weights_(b, std::clamp(std::lround(middle * static_cast<double>(size_) / rate_hz),
                                       0L, size_ / 2)) = 1;
        }
    }

    long length() const { return length_; }

    /// The energies of the bands around a sample.
    Eigen::VectorXd at(std::span<const float> sound, std::int64_t centre) {
        buffer_.assign(static_cast<std::size_t>(size_), 0);
        const std::int64_t from = centre - length_ / 2;
        const auto sample = [&](std::int64_t i) {
            return i >= 0 && i < static_cast<std::int64_t>(sound.size())
                       ? static_cast<double>(sound[static_cast<std::size_t>(i)])
                       : 0.0;
        };
        for (long i = 0; i < length_; ++i)
            buffer_[static_cast<std::size_t>(i)] =
                window_[static_cast<std::size_t>(i)] *
                (sample(from + i) - kPreEmphasis * sample(from + i - 1));
        transform();
        power_.resize(size_ / 2 + 1);
        for (long k = 0; k <= size_ / 2; ++k)
            power_[k] = std::norm(buffer_[static_cast<std::size_t>(k)]);
        return weights_ * power_ / static_cast<double>(length_);
    }

  private:
    /// The fast Fourier transform, in place.
    void transform() {
        const auto n = static_cast<std::size_t>(size_);
        for (std::size_t i = 1, j = 0; i < n; ++i) {
            std::size_t bit = n / 2;
            for (; j & bit; bit /= 2) j ^= bit;
            j ^= bit;
            if (i < j) std::swap(buffer_[i], buffer_[j]);
        }
        for (std::size_t half = 1; half < n; half *= 2)
            for (std::size_t at = 0; at < n; at += 2 * half)
                for (std::size_t k = 0; k < half; ++k) {
                    const std::complex<double> other =
                        buffer_[at + half + k] * turns_[k * (n / (2 * half))];
                    buffer_[at + half + k] = buffer_[at + k] - other;
                    buffer_[at + k] += other;
                }
    }

    long length_, size_ = 1;
    std::vector<double> window_;
    std::vector<std::complex<double>> turns_, buffer_;
    Eigen::MatrixXd weights_;
    Eigen::VectorXd power_;
};

double decibels(double power) { return 10 * std::log10(power + 1e-20); }

std::vector<double> levels_of(std::span<const float> sound, int rate_hz, long count) {
    std::vector<double> out;
    const auto reach = static_cast<std::int64_t>(kLongFrame_s * rate_hz / 2);
    for (long i = 0; i < count; ++i) {
        const std::int64_t centre = std::llround(static_cast<double>(i) * kCepstraHop_s * rate_hz);
        double sum = 0;
        for (std::int64_t k = std::max<std::int64_t>(0, centre - reach);
             k < std::min<std::int64_t>(centre + reach, static_cast<std::int64_t>(sound.size()));
             ++k)
            sum += static_cast<double>(sound[static_cast<std::size_t>(k)]) *
                   static_cast<double>(sound[static_cast<std::size_t>(k)]);
        out.push_back(decibels(sum / static_cast<double>(2 * reach)));
    }
    return out;
}

double percentile_of(std::vector<double> values, double percent) {
    const auto place =
        static_cast<std::size_t>(percent / 100 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<long>(place), values.end());
    return values[place];
}

void mark_silence(SoundFrames& frames) {
    const double loud = percentile_of(frames.level_db, 97),
                 soft = percentile_of(frames.level_db, 3);
    const double limit =
        std::clamp(soft + kAboveFloor_db, loud - kSilentBelow_db, loud - kSilentAbove_db);
    for (const double level : frames.level_db) frames.silent.push_back(level < limit);
}

/// Slopes over five frames.
Features slopes_of(const Features& values) {
    Features out(values.rows(), values.cols());
    const auto at = [&](long i) { return values.col(std::clamp(i, 0L, values.cols() - 1)); };
    for (long i = 0; i < values.cols(); ++i)
        out.col(i) = (at(i + 1) - at(i - 1) + 2 * (at(i + 2) - at(i - 2))) / 10;
    return out;
}

/// Mean 0 and variance 1 over the frames with speech.
void normalise(Features& values, const std::vector<bool>& silent) {
    for (long row = 0; row < values.rows(); ++row) {
        double sum = 0, squares = 0;
        long n = 0;
        for (long i = 0; i < values.cols(); ++i) {
            if (silent[static_cast<std::size_t>(i)]) continue;
            sum += values(row, i);
            squares += static_cast<double>(values(row, i)) * values(row, i);
            ++n;
        }
        const double mean = n ? sum / static_cast<double>(n) : 0;
        const double variance = n ? squares / static_cast<double>(n) - mean * mean : 0;
        const double scale = variance > 1e-12 ? 1 / std::sqrt(variance) : 1;
        values.row(row) =
            ((values.row(row).array() - static_cast<float>(mean)) * static_cast<float>(scale))
                .matrix();
    }
}

}  // namespace

double SoundFrames::spoken_s() const {
    const auto pause = static_cast<long>(kPauseLength_s / kCepstraHop_s);
    long spoken = 0;
    for (std::size_t i = 0; i < silent.size();) {
        std::size_t end = i;
        while (end < silent.size() && silent[end] == silent[i]) ++end;
        const bool edge = i == 0 || end == silent.size();
        if (!silent[i] || (static_cast<long>(end - i) < pause && !edge))
            spoken += static_cast<long>(end - i);
        i = end;
    }
    return static_cast<double>(spoken) * kCepstraHop_s;
}

double top_of_bands_hz(int one_hz, int other_hz) {
    return std::min(kHighest_hz, 0.47 * std::min(one_hz, other_hz));
}

SoundFrames frames_of(std::span<const float> sound, int rate_hz, double top_hz) {
    SoundFrames out;
    const auto count =
        static_cast<long>(static_cast<double>(sound.size()) / rate_hz / kCepstraHop_s) + 1;
    out.level_db = levels_of(sound, rate_hz, count);
    out.loudest_db = *std::max_element(out.level_db.begin(), out.level_db.end());
    mark_silence(out);
    BandFilter filter(rate_hz, kLongFrame_s, kBands, top_hz);
    Eigen::MatrixXd bands(kBands, count);
    for (long i = 0; i < count; ++i)
        bands.col(i) =
            filter.at(sound, std::llround(static_cast<double>(i) * kCepstraHop_s * rate_hz));
    const double floor = bands.maxCoeff() * std::pow(10, -kFloor_db / 10) + 1e-20;
    bands = (bands.array() + floor).log().matrix();
    Eigen::MatrixXd cosines(kCepstra, kBands);
    for (int k = 0; k < kCepstra; ++k)
        for (int b = 0; b < kBands; ++b)
            cosines(k, b) =
                k == 0 ? 1.0 / kBands : std::cos(std::numbers::pi * k * (b + 0.5) / kBands);
    Features values = (cosines * bands).cast<float>();
    Features slopes = slopes_of(values);
    normalise(values, out.silent);
    normalise(slopes, out.silent);
    slopes *= kDeltaWeight;
    for (int k = 1; k < kCepstra; ++k) {
        const float weight = std::exp(-kOrderLoss * static_cast<float>(k));
        values.row(k) *= weight;
        slopes.row(k) *= weight;
    }
    values.row(0) *= kEnergyWeight;
    slopes.row(0) *= kEnergyWeight;
    out.features.resize(2 * kCepstra, count);
    out.features << values, slopes;
    return out;
}

struct ShortSpectra::Impl {
    std::span<const float> sound;
    std::int64_t grid;
    BandFilter filter;
    std::map<std::int64_t, Eigen::ArrayXd> known;
};

ShortSpectra::ShortSpectra(std::span<const float> sound, int rate_hz)
    : impl_(new Impl{
          sound,
          std::max<std::int64_t>(1, rate_hz / 1000),
          BandFilter(rate_hz, kShortFrame_s, kShortBands, top_of_bands_hz(rate_hz, rate_hz)),
          {}}) {}

ShortSpectra::~ShortSpectra() = default;

const Eigen::ArrayXd& ShortSpectra::at(std::int64_t sample) {
    const std::int64_t place = sample / impl_->grid;
    const auto found = impl_->known.find(place);
    if (found != impl_->known.end()) return found->second;
    return impl_->known
        .emplace(place,
                 10 * (impl_->filter.at(impl_->sound, place * impl_->grid).array() + 1e-9).log10())
        .first->second;
}

}  // namespace risorius::speech
