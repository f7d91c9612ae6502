// PNG pictures through OpenCV, which keeps the bytes of 8-bit pixels as they are.
#include "media/image_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "media/detail/temporary_file.h"

namespace risorius::media {

namespace {

constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

/// Whether the chunks (length, type, data, checksum) run from the signature to IEND inside the
/// file. libpng would complain on standard error about a file cut short; this says it first.
bool chunks_are_whole(const std::vector<unsigned char>& bytes) {
    std::size_t at = kSignature.size();
    while (at + 12 <= bytes.size()) {
        const std::size_t length = (std::size_t{bytes[at]} << 24) |
                                   (std::size_t{bytes[at + 1]} << 16) |
                                   (std::size_t{bytes[at + 2]} << 8) | bytes[at + 3];
        if (length > bytes.size() - at - 12) return false;
        if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
        at += 12 + length;
    }
    return false;
}

}  // namespace

bool has_transparency(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return true;
    return false;
}

void write_png(const Image& image, const std::filesystem::path& file) {
    if (image.width_px < 1 || image.height_px < 1 ||
        image.rgba.size() != Image(image.width_px, image.height_px).rgba.size())
        throw Error(file.string(), "a picture of at least 1 x 1 pixels",
                    std::to_string(image.width_px) + " x " + std::to_string(image.height_px));
    const cv::Mat rgba(image.height_px, image.width_px, CV_8UC4,
                       const_cast<std::uint8_t*>(image.rgba.data()));
    cv::Mat stored;
    cv::cvtColor(rgba, stored, has_transparency(image) ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGBA2BGR);
    std::vector<unsigned char> bytes;
    bool encoded = false;
    try {
        encoded = cv::imencode(".png", stored, bytes);
    } catch (const cv::Exception& error) {
        throw RunError(file.string() + ": cannot be encoded as PNG: " + error.what());
    }
    if (!encoded) throw RunError(file.string() + ": cannot be encoded as PNG");
    detail::write_whole(file, bytes.data(), bytes.size());
}

Image read_png(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = detail::read_whole(file, "a PNG picture");
    if (bytes.size() < kSignature.size() ||
        !std::equal(kSignature.begin(), kSignature.end(), bytes.begin()))
        throw Error(file.string(), "a PNG picture", "another kind of file");
    if (!chunks_are_whole(bytes)) throw Error(file.string(), "a PNG picture", "one cut short");

    cv::Mat stored;
    try {
        stored = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
        stored.release();
    }
    if (stored.empty()) throw Error(file.string(), "a PNG picture", "damaged data");
    if (stored.depth() != CV_8U)
        throw Error(file.string(), "a PNG picture of 8 bits per channel", "16 bits per channel");

    Image image(stored.cols, stored.rows);
    cv::Mat rgba(image.height_px, image.width_px, CV_8UC4, image.rgba.data());
    const int conversion = stored.channels() == 1   ? cv::COLOR_GRAY2RGBA
                           : stored.channels() == 3 ? cv::COLOR_BGR2RGBA
                                                    : cv::COLOR_BGRA2RGBA;
    cv::cvtColor(stored, rgba, conversion);
    return image;
}

void put_text(Image& image, const std::string& text, int x, int y, int height_px) {
    constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
    constexpr double kCapitals_px = 21;  // of the font at scale 1
    cv::Mat pixels(image.height_px, image.width_px, CV_8UC4, image.rgba.data());
    cv::putText(pixels, text, {x, y}, kFont, height_px / kCapitals_px, {30, 30, 30, 255},
                height_px > 14 ? 2 : 1, cv::LINE_AA);
}

}  // namespace risorius::media
