// Making pictures lighter or darker and their contrast larger or smaller, and measuring many pictures as one.
//
//   Y    relative luminance, see luminance.h
//
// Every channel's linear light becomes gain * c + offset, held within 0 and 1, so that Y becomes gain * Y + offset and hues
// stay. The same bytes always become the same bytes: nothing hangs on the picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

struct Tone {
    double gain = 1, offset = 0;  ///< of linear light, 1 is white

    bool changes() const { return gain != 1 || offset != 0; }
};

class ToneCurve {
  public:
    explicit ToneCurve(const Tone& tone);

    std::uint8_t of(std::uint8_t byte) const { return byte_[byte]; }
    void apply(Image& image) const;  ///< opacity stays
    /// Share of the channels' values that are held at 0 or 1, of the pixels where the mask is not 0, or of all without one.
    double cut_off(const Image& image, const std::vector<std::uint16_t>& mask = {}) const;

  private:
    std::array<std::uint8_t, 256> byte_{};
    std::array<bool, 256> is_cut_{};
};

/// Sums over the pixels of many pictures, each pixel counting by its opacity.
struct LuminanceSums {
    double weight = 0, sum = 0, squares = 0;

    /// Where the mask is not 0, or everywhere without one.
    void add(const Image& image, const std::vector<std::uint16_t>& mask = {});
    void add(const LuminanceSums& others);
    double mean() const { return weight > 0 ? sum / weight : 0; }
    double sd() const;
};

/// What gives pictures of these sums that mean and standard deviation, but for what is cut off.
Tone tone_between(const LuminanceSums& from, double mean, double sd);

}  // namespace risorius::media
