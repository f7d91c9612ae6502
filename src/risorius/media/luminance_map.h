// SPDX-License-Identifier: MIT
/// \file
/// Gives pictures the same histogram of luminance, and the same amplitude spectrum. All pictures of a group, such as those of a head,
/// get the same map, so that equal pictures stay equal and nothing flickers.
///
///   Y    relative luminance in linear light; w: weight of a pixel, 0 to 1
///   T    quantile function of the target; F: distribution of Y within w, over all pictures of the group
///   z    (Y - mean of T) w; A(r): amplitude of z at r cycles per picture, root mean square over ring and pictures, for an area of 1
///
/// First Y becomes T(F(Y)). Then in each round
///   Y <- Y + z filtered by h(r) - 1, where w > 0, with h = A* / A, 0.1 to 10: no phase changes,
///   Y <- T(F(Y)), with F of the new values.
/// A* is the mean of A over groups, after the first step, with the energy that belongs to T.
///
/// Source: Willenbockel, Sadr, Fiset, Horne, Gosselin, Tanaka 2010, Behavior Research Methods 42(3), 671-684 (SHINE), which works on
/// whole pictures of 8 bits; here the region is soft and the light is linear.
#pragma once

#include <vector>

#include "risorius/core/image.h"

namespace risorius::media {

/// The luminance of a picture.
struct LuminancePlane {
    int width_px = 0, height_px = 0;
    std::vector<float> y, weights;
};
LuminancePlane luminance_plane(const Image& image, std::vector<float> weights);

/// A distribution of luminance. A quantile function has kQuantiles values, for 0 to 1 in equal steps.
class LuminanceDistribution {
  public:
    static constexpr int kQuantiles = 2049;

    void add(const LuminancePlane& plane);
    std::vector<double> quantiles() const;

  private:
    std::vector<double> bins_;
};

/// Moves and stretches a quantile function to a mean and standard deviation; the values stay within 0 to 1.
std::vector<double> with_mean_and_sd(std::vector<double> quantiles, double mean, double sd);
double mean_of_quantiles(const std::vector<double>& quantiles);
double sd_of_quantiles(const std::vector<double>& quantiles);

/// Amplitudes by cycles per picture, from 0: root mean square over pictures.
class RingAmplitudes {
  public:
    void add(const LuminancePlane& plane, double mean);
    std::vector<double> amplitudes() const;
    /// Energy of amplitudes in pictures of this size: equals the variance within the weights.
    static double energy(const std::vector<double>& amplitudes, int width_px, int height_px);

  private:
    std::vector<double> sums_;
    double area_ = 0;
};

/// The map of a group.
class LuminanceMap {
  public:
    LuminanceMap() = default;
    /// Fits the map to the pictures of a group. `target`: T. `amplitudes`: A*; empty: only the histogram. The pictures are mapped
    /// on the way.
    LuminanceMap(std::vector<LuminancePlane>& pictures, const std::vector<double>& target,
                 const std::vector<double>& amplitudes, int rounds);

    void apply(LuminancePlane& plane) const;

  private:
    struct Round {
        std::vector<double> gains;  ///< h by ring; empty: no filter
        std::vector<double> from;   ///< quantile function of what the curve maps to T
    };
    void apply(const Round& round, LuminancePlane& plane) const;
    std::vector<double> target_;
    double mean_ = 0;
    std::vector<Round> rounds_;
};

/// Gives a picture this luminance, with 16 bits where it has them. Hues stay; what would exceed 1 moves towards grey of the same
/// luminance. `grey`: all of it.
void set_luminance(const std::vector<float>& y, bool grey, Image& image);
/// Takes the colour off, luminance stays.
void make_grey(Image& image);

}  // namespace risorius::media
