// SPDX-License-Identifier: MIT
/// \file
/// The kinds of layers of the face network, on single pictures. All sums have a fixed order: the same bytes on every machine.
///
///   H, W   height and width of a picture      C   channels      K   numbers under a filter
///
/// Filters have the order of TensorFlow: row, column, channel in, channel out.
#pragma once

#include <vector>

namespace risorius::landmarks {

/// H x W x C, channels next to each other.
struct Picture {
    int height = 0, width = 0, channels = 0;
    std::vector<float> values;

    Picture() = default;
    Picture(int h, int w, int c);
    const float* at(int y, int x) const { return values.data() + offset(y, x); }
    float* at(int y, int x) { return values.data() + offset(y, x); }

  private:
    std::size_t offset(int y, int x) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

/// The filters of a convolution.
struct Filters {
    int rows = 1, columns = 1, channels_in = 1, channels_out = 1;
    int stride = 1;
    bool padded = false;  ///< TensorFlow's SAME: zeros around the picture, the larger half behind
    std::vector<float> weights;  ///< rows x columns x channels_in x channels_out
    std::vector<float> bias;     ///< channels_out, or empty
};

Picture convolved(const Picture& in, const Filters& filters);
/// Each channel has its own filter: channels_out is 1, and channels_in those of the picture.
Picture convolved_by_channel(const Picture& in, const Filters& filters);
/// The largest of each square of `size` x `size`, without overlap.
Picture pooled(const Picture& in, int size);
Picture sum_of(const Picture& a, const Picture& b);
/// Adds empty channels behind the last.
Picture with_channels(const Picture& in, int channels);
/// x where it is positive, else slope x; one slope per channel.
void apply_slopes(const std::vector<float>& slopes, Picture& picture);

}  // namespace risorius::landmarks
