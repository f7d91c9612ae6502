// SPDX-License-Identifier: MIT
#include "risorius/render/detail/resolve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "risorius/core/srgb.h"

namespace risorius::render {
namespace {

/// Whether the n x n samples starting at `first` are equal, byte for byte.
bool is_even(const std::uint8_t* first, std::size_t n, std::size_t sample_row) {
    std::uint32_t one = 0;
    std::memcpy(&one, first, 4);
    std::uint32_t differs = 0;
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            std::uint32_t other = 0;
            std::memcpy(&other, first + j * sample_row + 4 * i, 4);
            differs |= one ^ other;
        }
    return differs == 0;
}

bool is_empty(const std::uint8_t* sample) {
    return (sample[0] | sample[1] | sample[2] | sample[3]) == 0;
}

}  // namespace

Resolve::Resolve(const Background& background)
    : transparent_(background.transparent), byte_of_linear_(65536) {
    for (std::size_t i = 0; i < 256; ++i)
        linear_of_byte_[i] = static_cast<std::uint16_t>(
            std::lround(65535 * linear_of_srgb(static_cast<double>(i) / 255)));
    for (std::size_t i = 0; i < 65536; ++i)
        byte_of_linear_[i] = static_cast<std::uint8_t>(
            std::lround(255 * srgb_of_linear(static_cast<double>(i) / 65535)));
    for (std::size_t k = 0; k < 3; ++k)
        background_[k] =
            static_cast<std::uint8_t>(std::lround(255 * std::clamp(background.rgb[k], 0.0, 1.0)));
    if (!transparent_) nothing_ = {background_[0], background_[1], background_[2], 255};
}

Image mean_of(const std::vector<Image>& pictures) {
    Image mean = pictures.front();
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < 256; ++i)
        linear[i] = static_cast<float>(linear_of_srgb(static_cast<double>(i) / 255));
    const auto count = static_cast<float>(pictures.size());
    for (std::size_t p = 0; p < mean.rgba.size(); p += 4) {
        float sum[3] = {0, 0, 0}, alpha = 0;
        for (const Image& picture : pictures) {
            const float a = picture.rgba[p + 3];
            alpha += a;
            for (std::size_t k = 0; k < 3; ++k) sum[k] += a * linear[picture.rgba[p + k]];
        }
        if (alpha <= 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
            mean.rgba[p + k] = static_cast<std::uint8_t>(
                std::lround(255 * srgb_of_linear(std::min(1.0F, sum[k] / alpha))));
        mean.rgba[p + 3] = static_cast<std::uint8_t>(std::lround(alpha / count));
    }
    for (std::size_t p = 0; p < mean.deep.size(); p += 4) {
        double sum[3] = {0, 0, 0}, alpha = 0;
        for (const Image& picture : pictures) {
            const double a = picture.deep[p + 3];
            alpha += a;
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += a * linear_of_srgb(picture.deep[p + k] / 65535.0);
        }
        if (alpha <= 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
            mean.deep[p + k] = static_cast<std::uint16_t>(std::lround(
                65535 * srgb_of_linear(std::min(1.0F, static_cast<float>(sum[k] / alpha)))));
        mean.deep[p + 3] =
            static_cast<std::uint16_t>(std::lround(alpha / static_cast<double>(count)));
    }
    return mean;
}

void Resolve::row(const std::uint8_t* samples, std::size_t n, std::size_t sample_row,
                  std::size_t pixels, std::uint8_t* out) const {
    const auto count = static_cast<std::uint32_t>(n * n);
    const std::array<std::uint32_t, 3> behind{linear_of_byte_[background_[0]],
                                              linear_of_byte_[background_[1]],
                                              linear_of_byte_[background_[2]]};
    for (std::size_t x = 0; x < pixels; ++x, out += 4) {
        // Most pixels have equal samples; their mean is the sample itself.
        if (const std::uint8_t* first = samples + x * n * 4;
            (n == 1 || is_even(first, n, sample_row)) && (first[3] == 255 || is_empty(first))) {
            std::memcpy(out, first[3] == 255 ? first : nothing_.data(), 4);
            continue;
        }
        std::uint32_t sum[3] = {0, 0, 0};
        std::uint32_t alpha = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const std::uint8_t* s = samples + j * sample_row + x * n * 4;
            for (std::size_t i = 0; i < n; ++i, s += 4) {
                alpha += s[3];
                for (std::size_t k = 0; k < 3; ++k) sum[k] += linear_of_byte_[s[k]];
            }
        }
        if (transparent_) {
            if (alpha > 0)
                for (std::size_t k = 0; k < 3; ++k)
                    out[k] = byte_of_linear_[std::min(65535U, (sum[k] * 255 + alpha / 2) / alpha)];
            out[3] = static_cast<std::uint8_t>((alpha + count / 2) / count);
        } else {
            const std::uint32_t open = 255 * count - alpha;
            for (std::size_t k = 0; k < 3; ++k)
                out[k] = byte_of_linear_[std::min(
                    65535U, (sum[k] + open * behind[k] / 255 + count / 2) / count)];
            out[3] = 255;
        }
    }
}

void Resolve::opaque_row(const std::uint8_t* samples, std::size_t n, std::size_t sample_row,
                         std::size_t pixels, std::uint8_t* out) const {
    const auto count = static_cast<std::uint32_t>(n * n);
    for (std::size_t x = 0; x < pixels; ++x, out += 4) {
        const std::uint8_t* first = samples + x * n * 4;
        if (n == 1) {
            std::memcpy(out, first, 3);
        } else {
            std::uint32_t sum[3] = {0, 0, 0};
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t i = 0; i < n; ++i)
                    for (std::size_t k = 0; k < 3; ++k)
                        sum[k] += linear_of_byte_[first[j * sample_row + 4 * i + k]];
            for (std::size_t k = 0; k < 3; ++k)
                out[k] = byte_of_linear_[(sum[k] + count / 2) / count];
        }
        out[3] = 255;
    }
}

void Resolve::empty_row(std::size_t pixels, std::uint8_t* out) const {
    const std::array<std::uint8_t, 4> one = nothing_;
    for (std::size_t x = 0; x < pixels; ++x) std::memcpy(out + 4 * x, one.data(), 4);
}

void Resolve::operator()(const std::vector<std::uint8_t>& samples, int supersampling,
                         const Tile& tile, Image& image) const {
    const auto n = static_cast<std::size_t>(supersampling);
    const auto width = static_cast<std::size_t>(tile.width);
    const std::size_t sample_row = width * n * 4;
    for (int y = 0; y < tile.height; ++y)
        row(samples.data() + static_cast<std::size_t>(tile.height - 1 - y) * n * sample_row, n,
            sample_row, width, image.pixel(tile.x, tile.y + y));
}

}  // namespace risorius::render
