// SPDX-License-Identifier: MIT
/// \file
/// Phase-scrambled pictures: within a soft region, every spatial frequency keeps its amplitude, and its phase is shifted at random.
/// All pictures of a scrambler get the same shifts, so that static parts stay static.
///
///   z    (c - mean of c) w, for the linear light c of each channel; w is the weight of a pixel, 0 to 1
///   n    z with shifted phases and a gain G(r) of the radial frequency r. Windowing by w changes amplitudes, so G is found in the
///        first picture such that w n has the energy of z in each octave. All pictures get the same G.
///
/// The picture becomes w (mean + k n + offset) + (1 - w) c, with k and offset for the mean and standard deviation that Y has within w.
///
/// Source: stimuli of vision research, e.g. Dakin, Hess, Ledgeway & Achtman 2002, Current Biology 12(14).
#pragma once

#include <memory>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// Scrambles pictures of one size. The same seed gives the same shifts.
class PhaseScrambler {
  public:
    PhaseScrambler(int width_px, int height_px, unsigned seed);
    ~PhaseScrambler();

    /// Scrambles an opaque picture. `weights`: one per pixel, 0..1; pixels of weight 0 keep their bytes. Red, green and blue get the
    /// same shifts, which preserves colours.
    void scramble(Image& image, const std::vector<float>& weights);

    /// Returns the RMS over octaves of how far their energy in the first picture is from that before, ratio.
    double octave_error() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
