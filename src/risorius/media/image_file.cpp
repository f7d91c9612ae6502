// SPDX-License-Identifier: MIT
// PNG pictures through libpng, which keeps the bytes of 8-bit sRGB pixels. OpenCV's reader for all formats would load 77 more
// libraries at every start of the program.
#include "risorius/media/image_file.h"

#include <png.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/media/detail/png_chunks.h"
#include "risorius/media/detail/png_samples.h"
#include "risorius/media/detail/temporary_file.h"

namespace risorius::media {

namespace {

/// Checks that the chunks (length, type, data, checksum) extend from the signature to IEND within the file. Otherwise libpng
/// would complain about an incomplete file on standard error.
bool chunks_are_whole(const std::vector<unsigned char>& bytes) {
    for (std::size_t at = detail::kPngSignature.size();;) {
        const auto chunk = detail::png_chunk(bytes, at);
        if (!chunk || chunk->size > bytes.size() - at) return false;
        if (chunk->type == "IEND") return true;
        at += chunk->size;
    }
}

png_image described(int width_px, int height_px, png_uint_32 format) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width_px);
    png.height = static_cast<png_uint_32>(height_px);
    png.format = format;
    return png;
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        rgb.insert(rgb.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                   image.rgba.begin() + static_cast<std::ptrdiff_t>(i + 3));
    return rgb;
}

}  // namespace

bool has_transparency(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return true;
    return false;
}

std::string png_bytes(const Image& image, const std::string& name, PngSize size) {
    if (image.width_px < 1 || image.height_px < 1 ||
        image.rgba.size() != Image(image.width_px, image.height_px).rgba.size())
        throw Error(name, "a picture of at least 1 x 1 pixels",
                    std::to_string(image.width_px) + " x " + std::to_string(image.height_px));
    const std::vector<std::uint8_t> opaque =
        has_transparency(image) ? std::vector<std::uint8_t>() : without_alpha(image);
    png_image png = described(image.width_px, image.height_px,
                              opaque.empty() ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB);
    png.flags = size == PngSize::kFast ? PNG_IMAGE_FLAG_FAST : 0;
    const void* const pixels = opaque.empty() ? image.rgba.data() : opaque.data();
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
    png_alloc_size_t length = bytes.size();
    if (!png_image_write_to_memory(&png, bytes.data(), &length, 0, pixels, 0, nullptr))
        throw RunError(name + ": cannot be encoded as PNG: " + png.message);
    bytes.resize(length);
    return bytes;
}

void write_png(const Image& image, const std::filesystem::path& file) {
    write_file(file, png_bytes(image, file.string(), PngSize::kFast));
}

void write_png16(const Image& image, const std::filesystem::path& file) {
    const int channels = has_transparency(image) ? 4 : 3;
    detail::PngSamples out{.width_px = image.width_px,
                           .height_px = image.height_px,
                           .channels = channels,
                           .bits = 16,
                           .srgb = true,
                           .samples = {}};
    out.samples.reserve(image.rgba.size() / 4 * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (channels == 4 || i % 4 != 3)
            out.samples.push_back(image.deep.empty()
                                      ? static_cast<std::uint16_t>(image.rgba[i] * 257)
                                      : image.deep[i]);
    detail::write_png_samples(out, file);
}

void write_grey_png(int width_px, int height_px, int bits,
                    const std::vector<std::uint16_t>& samples, const std::filesystem::path& file) {
    detail::write_png_samples({.width_px = width_px,
                               .height_px = height_px,
                               .channels = 1,
                               .bits = bits,
                               .srgb = false,
                               .samples = samples},
                              file);
}

Image read_png(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = detail::read_whole(file, "a PNG picture");
    if (!detail::is_png(bytes)) throw Error(file.string(), "a PNG picture", "another kind of file");
    if (!chunks_are_whole(bytes)) throw Error(file.string(), "a PNG picture", "one cut short");

    png_image png = described(0, 0, PNG_FORMAT_RGBA);
    if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
        throw Error(file.string(), "a PNG picture", "damaged data");
    if (png.format & PNG_FORMAT_FLAG_LINEAR) {
        png_image_free(&png);
        throw Error(file.string(), "a PNG picture of 8 bits per channel", "16 bits per channel");
    }
    if (std::int64_t{png.width} * png.height > kMostPixels) {
        const std::string size = std::to_string(png.width) + " x " + std::to_string(png.height);
        png_image_free(&png);
        throw Error(file.string(), kFewerPixels, size);
    }
    png.format = PNG_FORMAT_RGBA;
    Image image(static_cast<int>(png.width), static_cast<int>(png.height));
    if (!png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr))
        throw Error(file.string(), "a PNG picture", "damaged data");
    return image;
}

void put_text(Image& image, const std::string& text, int x, int y, int height_px) {
    constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
    constexpr double kCapitals_px = 21;  // height of capitals at scale 1
    cv::Mat pixels(image.height_px, image.width_px, CV_8UC4, image.rgba.data());
    cv::putText(pixels, text, {x, y}, kFont, height_px / kCapitals_px, {30, 30, 30, 255},
                height_px > 14 ? 2 : 1, cv::LINE_AA);
}

}  // namespace risorius::media
