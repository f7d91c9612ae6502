// SPDX-License-Identifier: MIT
#include "risorius/media/detail/png_samples.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"

namespace risorius::media::detail {

namespace {

struct PngSink {
    std::vector<unsigned char> bytes;
    std::string failure;
};

void put_png_bytes(png_structp png, png_bytep from, png_size_t count) {
    auto* sink = static_cast<PngSink*>(png_get_io_ptr(png));
    sink->bytes.insert(sink->bytes.end(), from, from + count);
}

void note_png_failure(png_structp png, png_const_charp text) {
    static_cast<PngSink*>(png_get_error_ptr(png))->failure = text;
    png_longjmp(png, 1);
}

void ignore_png_warning(png_structp, png_const_charp) {}

std::vector<unsigned char> big_endian_rows(const PngSamples& picture) {
    std::vector<unsigned char> bytes;
    bytes.reserve(picture.samples.size() * static_cast<std::size_t>(picture.bits / 8));
    for (const std::uint16_t sample : picture.samples) {
        if (picture.bits == 16) bytes.push_back(static_cast<unsigned char>(sample >> 8));
        bytes.push_back(static_cast<unsigned char>(sample & 0xff));
    }
    return bytes;
}

/// Must not contain objects with destructors, because libpng leaves it by longjmp on errors.
bool encode_png(const PngSamples& picture, const unsigned char* rows, PngSink& sink) {
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, note_png_failure, ignore_png_warning);
    if (!png) return false;
    png_infop info = png_create_info_struct(png);
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &sink, put_png_bytes, nullptr);
    png_set_compression_level(png, 3);
    const int colour = picture.channels == 1   ? PNG_COLOR_TYPE_GRAY
                       : picture.channels == 3 ? PNG_COLOR_TYPE_RGB
                                               : PNG_COLOR_TYPE_RGBA;
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width_px),
                 static_cast<png_uint_32>(picture.height_px), picture.bits, colour,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (picture.srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    const std::size_t row = static_cast<std::size_t>(picture.width_px) *
                            static_cast<std::size_t>(picture.channels * picture.bits / 8);
    for (int y = 0; y < picture.height_px; ++y)
        png_write_row(png, rows + static_cast<std::size_t>(y) * row);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

}  // namespace

void write_png_samples(const PngSamples& picture, const std::filesystem::path& file) {
    const std::vector<unsigned char> rows = big_endian_rows(picture);
    PngSink sink;
    if (!encode_png(picture, rows.data(), sink))
        throw RunError(file.string() + ": cannot be encoded as PNG: " + sink.failure);
    write_file(file, {reinterpret_cast<const char*>(sink.bytes.data()), sink.bytes.size()});
}

}  // namespace risorius::media::detail
