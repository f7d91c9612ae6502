// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/layers.h"

#include <algorithm>
#include <cassert>

namespace risorius::landmarks {

namespace {

constexpr int kLanes = 8, kTogether = 4;  // channels and pixels of one block of sums

/// Extent of the result, and the zeros before the first pixel.
struct Extent {
    int size, before;
};
Extent extent(int size, int filter, const Filters& filters) {
    if (!filters.padded) return {(size - filter) / filters.stride + 1, 0};
    const int out = (size + filters.stride - 1) / filters.stride;
    return {out, std::max(0, (out - 1) * filters.stride + filter - size) / 2};
}

/// Copies what lies under the filter at (y, x) of the result.
void take_patch(const Picture& in, const Filters& f, int top, int left, float* patch) {
    const std::size_t channels = static_cast<std::size_t>(in.channels);
    for (int r = 0; r < f.rows; ++r)
        for (int c = 0; c < f.columns; ++c, patch += channels) {
            const int y = top + r, x = left + c;
            if (y < 0 || x < 0 || y >= in.height || x >= in.width)
                std::fill_n(patch, channels, 0.0F);
            else
                std::copy_n(in.at(y, x), channels, patch);
        }
}

/// out[p][c] = bias[c] + sum over k of patches[p][k] weights[k][c], for kTogether pixels. `stride`: of a row of weights.
void multiply(const float* patches, std::size_t count, const float* weights, std::size_t stride,
              const float* bias, float (&sums)[kTogether][kLanes]) {
    for (auto& row : sums) std::copy_n(bias, kLanes, row);
    for (std::size_t k = 0; k < count; ++k) {
        const float* w = weights + k * stride;
        for (int p = 0; p < kTogether; ++p) {
            const float x = patches[static_cast<std::size_t>(p) * count + k];
            for (int c = 0; c < kLanes; ++c) sums[p][c] += x * w[c];
        }
    }
}

}  // namespace

Picture::Picture(int h, int w, int c)
    : height(h),
      width(w),
      channels(c),
      values(static_cast<std::size_t>(h) * static_cast<std::size_t>(w) *
             static_cast<std::size_t>(c)) {}

Picture convolved(const Picture& in, const Filters& f) {
    assert(in.channels == f.channels_in);
    const Extent high = extent(in.height, f.rows, f), wide = extent(in.width, f.columns, f);
    const std::size_t out_channels = static_cast<std::size_t>(f.channels_out),
                      lanes = (out_channels + kLanes - 1) / kLanes * kLanes,
                      count = static_cast<std::size_t>(f.rows * f.columns * f.channels_in);
    // Rows of weights filled up to whole blocks
    std::vector<float> weights(count * lanes, 0.0F), bias(lanes, 0.0F);
    for (std::size_t k = 0; k < count; ++k)
        std::copy_n(f.weights.data() + k * out_channels, out_channels, weights.data() + k * lanes);
    std::copy(f.bias.begin(), f.bias.end(), bias.begin());

    Picture out(high.size, wide.size, f.channels_out);
    std::vector<float> patches(kTogether * count);
    float sums[kTogether][kLanes];
    for (int y = 0; y < high.size; ++y)
        for (int x = 0; x < wide.size; x += kTogether) {
            const int pixels = std::min(kTogether, wide.size - x);
            for (int p = 0; p < pixels; ++p)
                take_patch(in, f, y * f.stride - high.before, (x + p) * f.stride - wide.before,
                           patches.data() + static_cast<std::size_t>(p) * count);
            for (std::size_t c = 0; c < out_channels; c += kLanes) {
                multiply(patches.data(), count, weights.data() + c, lanes, bias.data() + c, sums);
                for (int p = 0; p < pixels; ++p)
                    std::copy_n(sums[p], std::min<std::size_t>(kLanes, out_channels - c),
                                out.at(y, x + p) + c);
            }
        }
    return out;
}

Picture convolved_by_channel(const Picture& in, const Filters& f) {
    assert(in.channels == f.channels_in && f.channels_out == 1);
    const Extent high = extent(in.height, f.rows, f), wide = extent(in.width, f.columns, f);
    Picture out(high.size, wide.size, in.channels);
    for (int y = 0; y < high.size; ++y)
        for (int x = 0; x < wide.size; ++x) {
            float* to = out.at(y, x);
            if (!f.bias.empty()) std::copy(f.bias.begin(), f.bias.end(), to);
            for (int r = 0; r < f.rows; ++r)
                for (int c = 0; c < f.columns; ++c) {
                    const int from_y = y * f.stride - high.before + r,
                              from_x = x * f.stride - wide.before + c;
                    if (from_y < 0 || from_x < 0 || from_y >= in.height || from_x >= in.width)
                        continue;
                    const float* from = in.at(from_y, from_x);
                    const float* w =
                        f.weights.data() + static_cast<std::ptrdiff_t>(r * f.columns + c) *
                                               static_cast<std::ptrdiff_t>(in.channels);
                    for (int k = 0; k < in.channels; ++k) to[k] += from[k] * w[k];
                }
        }
    return out;
}

Picture pooled(const Picture& in, int size) {
    Picture out(in.height / size, in.width / size, in.channels);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            float* to = out.at(y, x);
            std::copy_n(in.at(y * size, x * size), in.channels, to);
            for (int r = 0; r < size; ++r)
                for (int c = 0; c < size; ++c) {
                    const float* from = in.at(y * size + r, x * size + c);
                    for (int k = 0; k < in.channels; ++k) to[k] = std::max(to[k], from[k]);
                }
        }
    return out;
}

Picture sum_of(const Picture& a, const Picture& b) {
    assert(a.values.size() == b.values.size());
    Picture out = a;
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += b.values[i];
    return out;
}

Picture with_channels(const Picture& in, int channels) {
    Picture out(in.height, in.width, channels);
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x) std::copy_n(in.at(y, x), in.channels, out.at(y, x));
    return out;
}

void apply_slopes(const std::vector<float>& slopes, Picture& picture) {
    assert(slopes.size() == static_cast<std::size_t>(picture.channels));
    for (std::size_t i = 0; i < picture.values.size(); i += slopes.size())
        for (std::size_t c = 0; c < slopes.size(); ++c)
            if (picture.values[i + c] < 0) picture.values[i + c] *= slopes[c];
}

}  // namespace risorius::landmarks
