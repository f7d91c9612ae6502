// SPDX-License-Identifier: MIT
#include "risorius/media/hdr_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"

namespace risorius::media {
namespace {

constexpr int kMaxSide = 16384;
// A light of that size takes 1.4 GB and 15 s until it is drawn.
constexpr std::int64_t kMaxPixels = std::int64_t{8192} * 4096;
constexpr FileKind kHdrPicture{"a Radiance .hdr file", 1000 * kMegabyte};

class RowReader {
  public:
    RowReader(std::string_view bytes, const std::filesystem::path& file)
        : bytes_(bytes), file_(file) {}

    /// Reads one row of RGBE pixels, run-length encoded by channel or plain.
    void read(std::vector<std::array<std::uint8_t, 4>>& row) {
        const auto width = row.size();
        std::array<std::uint8_t, 4> first;
        for (std::uint8_t& byte : first) byte = next();
        if (first[0] != 2 || first[1] != 2 || first[2] > 127 || width < 8) {
            row[0] = first;
            for (std::size_t x = 1; x < width; ++x)
                for (std::uint8_t& byte : row[x]) byte = next();
            return;
        }
        for (std::size_t channel = 0; channel < 4; ++channel)
            for (std::size_t x = 0; x < width;) {
                int count = next();
                const bool run = count > 128;
                if (run) count -= 128;
                if (count == 0 || x + static_cast<std::size_t>(count) > width)
                    throw Error(file_.string(), "rows as long as the picture is wide",
                                "a longer one");
                std::uint8_t value = run ? next() : 0;
                for (int i = 0; i < count; ++i, ++x) row[x][channel] = run ? value : next();
            }
    }

  private:
    std::uint8_t next() {
        if (bytes_.empty())
            throw Error(file_.string(), "pixels of the whole picture", "the end of the file");
        const char byte = bytes_.front();
        bytes_.remove_prefix(1);
        return static_cast<std::uint8_t>(byte);
    }
    std::string_view bytes_;
    const std::filesystem::path& file_;
};

}  // namespace

HdrPicture read_hdr(const std::filesystem::path& file) {
    const std::string bytes = read_file(file, kHdrPicture);
    std::string_view rest = bytes;
    const auto next_line = [&rest] {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        return line;
    };
    if (!next_line().starts_with("#?"))
        throw Error(file.string(), "a Radiance .hdr file", "another one");
    bool rgbe = false;
    for (std::string_view line = next_line(); !line.empty(); line = next_line())
        rgbe |= line == "FORMAT=32-bit_rle_rgbe";
    if (!rgbe) throw Error(file.string(), "FORMAT=32-bit_rle_rgbe", "another format");
    const std::string line(next_line().substr(0, 100));
    HdrPicture picture;
    if (std::sscanf(line.c_str(), "-Y %9d +X %9d", &picture.height, &picture.width) != 2 ||
        picture.height < 1 || picture.width < 1 || picture.height > kMaxSide ||
        picture.width > kMaxSide)
        throw Error(file.string(), "a size like \"-Y 512 +X 1024\"", "\"" + line + "\"");

    if (std::int64_t{picture.height} * picture.width > kMaxPixels)
        throw Error(file.string(), "at most as many pixels as 8192 x 4096",
                    std::to_string(picture.width) + " x " + std::to_string(picture.height));
    std::vector<std::array<std::uint8_t, 4>> row(static_cast<std::size_t>(picture.width));
    // Of the shortest encoding, one byte stands for at most 127 pixels of one channel. A size that the bytes cannot fill takes
    // no memory.
    if (static_cast<double>(rest.size()) * 127 < static_cast<double>(row.size()) * picture.height)
        throw Error(file.string(), "pixels of the whole picture", "the end of the file");
    RowReader rows(rest, file);
    picture.rgb.reserve(3 * row.size() * static_cast<std::size_t>(picture.height));
    for (int y = 0; y < picture.height; ++y) {
        rows.read(row);
        for (const auto& pixel : row) {
            const float scale = pixel[3] == 0 ? 0.0F : std::ldexp(1.0F, pixel[3] - 136);
            for (std::size_t k = 0; k < 3; ++k)
                picture.rgb.push_back(scale * static_cast<float>(pixel[k]));
        }
    }
    return picture;
}

}  // namespace risorius::media
