// SPDX-License-Identifier: MIT
/// \file
/// What a sound is like, every 5 ms: cepstra of its spectrum on the mel scale, as recognisers of speech use them.
///
///   c_1 .. c_12   cosine transform of the logarithms of 26 mel bands; c_0 is replaced by the energy
///   deltas        slope of each over 5 frames
///
/// Each coefficient has mean 0 and variance 1 over the speech of its sound, so that speakers and microphones differ less.
/// Source: S. Davis & P. Mermelstein 1980, IEEE Trans. Acoust. Speech Signal Process. 28(4), 357-366.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace risorius::speech {

inline constexpr double kCepstraHop_s = 0.005;

/// Features of one frame in each column.
using Features = Eigen::MatrixXf;

/// A sound in frames. Frame i is centred at the time i * kCepstraHop_s.
struct SoundFrames {
    Features features;
    std::vector<double> level_db;  ///< of each frame, 0: full scale
    std::vector<bool> silent;      ///< below the level of speech
    double loudest_db = -200;

    long count() const { return features.cols(); }
    /// The time in frames that is not in silences of 0.2 s and more, s.
    double spoken_s() const;
};

/// `top_hz`: upper edge of the highest band; at most half of the rate.
SoundFrames frames_of(std::span<const float> sound, int rate_hz, double top_hz);

/// The greatest `top_hz` that fits sounds with these two rates.
double top_of_bands_hz(int one_hz, int other_hz);

/// Logarithms of the energy in mel bands of a short piece of sound around a sample, for finding borders.
class ShortSpectra {
  public:
    ShortSpectra(std::span<const float> sound, int rate_hz);
    ~ShortSpectra();
    /// Band energies, dB, of the 10 ms around a sample.
    const Eigen::ArrayXd& at(std::int64_t sample);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::speech
