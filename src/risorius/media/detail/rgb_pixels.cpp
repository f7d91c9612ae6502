// SPDX-License-Identifier: MIT
#include "risorius/media/detail/rgb_pixels.h"

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

}  // namespace

bool is_rgb_of_bytes(AVPixelFormat format) {
    const AVPixFmtDescriptor* d = av_pix_fmt_desc_get(format);
    return d && (d->flags & AV_PIX_FMT_FLAG_RGB) != 0 && d->nb_components >= 3 &&
           d->comp[0].depth == 8;
}

void put_rgb_pixels(const Image& image, AVFrame& frame) {
    each_row(frame, [&](int channel, std::uint8_t* to, int step, int y) {
        const std::uint8_t* from = image.pixel(0, y) + channel;
        for (int x = 0; x < image.width_px; ++x, from += 4, to += step) *to = *from;
    });
}

Image rgb_pixels_of(const AVFrame& frame) {
    Image image(frame.width, frame.height);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    each_row(frame, [&](int channel, const std::uint8_t* from, int step, int y) {
        std::uint8_t* to = image.pixel(0, y) + channel;
        for (int x = 0; x < image.width_px; ++x, from += step, to += 4) *to = *from;
    });
    return image;
}

}  // namespace risorius::media::detail
