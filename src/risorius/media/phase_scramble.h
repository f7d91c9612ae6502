// Pictures without what they show: every spatial frequency keeps its amplitude, its phase is mixed by chance. The same phases for every
// picture of a scrambler, so that what does not move stands still.
// Source: as stimuli of vision research have it, e.g. Dakin, Hess, Ledgeway & Achtman 2002, Current Biology 12(14).
#pragma once

#include <memory>

#include "risorius/core/image.h"

namespace risorius::media {

class PhaseScrambler {
  public:
    PhaseScrambler(int width_px, int height_px, unsigned seed);
    ~PhaseScrambler();

    /// Red, green and blue by the same phases, so that colours stay; the mean stays but for what is cut off at black and white.
    void scramble(Image& image) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::media
