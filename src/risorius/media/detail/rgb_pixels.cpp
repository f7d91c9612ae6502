// SPDX-License-Identifier: MIT
#include "risorius/media/detail/rgb_pixels.h"

#include <bit>
#include <cstring>

namespace risorius::media::detail {

namespace {

/// Calls at(channel of the image, its first byte in a row of the frame, bytes to the next pixel, row) for every channel and
/// row.
template <typename At>
void each_row(const AVFrame& frame, At at) {
    const AVPixFmtDescriptor* format =
        av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    for (int y = 0; y < frame.height; ++y)
        for (int c = 0; c < format->nb_components; ++c) {
            const AVComponentDescriptor& part = format->comp[c];
            at(c,
               frame.data[part.plane] + std::ptrdiff_t{y} * frame.linesize[part.plane] +
                   part.offset,
               part.step, y);
        }
}

bool is_deep(const AVFrame& frame) {
    return av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format))->comp[0].depth == 16;
}

}  // namespace

bool is_rgb_of_whole_bytes(AVPixelFormat format) {
    const AVPixFmtDescriptor* d = av_pix_fmt_desc_get(format);
    if (!d || (d->flags & AV_PIX_FMT_FLAG_RGB) == 0 || d->nb_components < 3) return false;
    const bool is_little = (d->flags & AV_PIX_FMT_FLAG_BE) == 0;
    return d->comp[0].depth == 8 ||
           (d->comp[0].depth == 16 && is_little == (std::endian::native == std::endian::little));
}

void put_rgb_pixels(const Image& image, AVFrame& frame) {
    const bool deep = is_deep(frame);
    each_row(frame, [&](int channel, std::uint8_t* to, int step, int y) {
        const std::uint8_t* from = image.pixel(0, y) + channel;
        if (!deep) {
            for (int x = 0; x < image.width_px; ++x, from += 4, to += step) *to = *from;
            return;
        }
        const std::ptrdiff_t first = from - image.rgba.data();
        for (int x = 0; x < image.width_px; ++x, to += step) {
            const auto at = static_cast<std::size_t>(first + 4 * std::ptrdiff_t{x});
            const auto value = image.deep.empty() ? static_cast<std::uint16_t>(257 * image.rgba[at])
                                                  : image.deep[at];
            std::memcpy(to, &value, sizeof value);
        }
    });
}

Image rgb_pixels_of(const AVFrame& frame) {
    const bool deep = is_deep(frame);
    Image image(frame.width, frame.height);
    if (deep) image.deep.assign(image.rgba.size(), 65535);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    each_row(frame, [&](int channel, const std::uint8_t* from, int step, int y) {
        std::uint8_t* to = image.pixel(0, y) + channel;
        if (!deep) {
            for (int x = 0; x < image.width_px; ++x, from += step, to += 4) *to = *from;
            return;
        }
        std::uint16_t* out = image.deep.data() + (to - image.rgba.data());
        for (int x = 0; x < image.width_px; ++x, from += step, to += 4, out += 4) {
            std::memcpy(out, from, sizeof *out);
            *to = static_cast<std::uint8_t>((*out + 128U) / 257U);
        }
    });
    return image;
}

}  // namespace risorius::media::detail
