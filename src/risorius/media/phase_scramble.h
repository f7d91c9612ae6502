// SPDX-License-Identifier: MIT
/// \file
/// Phase-scrambled pictures: every spatial frequency keeps its amplitude, and its phase is shifted at random. All pictures of a
/// scrambler get the same shifts, so that static parts stay static.
///
/// Source: stimuli of vision research, e.g. Dakin, Hess, Ledgeway & Achtman 2002, Current Biology 12(14).
#pragma once

#include <memory>

#include "risorius/core/image.h"

namespace risorius::media {

/// Scrambles pictures of one size. The same seed gives the same shifts.
class PhaseScrambler {
  public:
    PhaseScrambler(int width_px, int height_px, unsigned seed);
    ~PhaseScrambler();

    /// Red, green and blue get the same shifts, which preserves colours. The mean is preserved except for clipping at black and
    /// white.
    void scramble(Image& image) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
