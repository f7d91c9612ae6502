// SPDX-License-Identifier: MIT
#include "risorius/media/hdr_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

#include "risorius/core/error.h"

namespace risorius::media {
namespace {

constexpr int kMaxSide = 16384;

class RowReader {
  public:
    RowReader(std::ifstream& in, const std::filesystem::path& file) : in_(in), file_(file) {}

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
        const int byte = in_.get();
        if (byte < 0)
            throw Error(file_.string(), "pixels of the whole picture", "the end of the file");
        return static_cast<std::uint8_t>(byte);
    }
    std::ifstream& in_;
    const std::filesystem::path& file_;
};

}  // namespace

HdrPicture read_hdr(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    std::getline(in, line);
    if (!in || !line.starts_with("#?"))
        throw Error(file.string(), "a Radiance .hdr file", "another one");
    bool rgbe = false;
    while (std::getline(in, line) && !line.empty()) rgbe |= line == "FORMAT=32-bit_rle_rgbe";
    if (!rgbe) throw Error(file.string(), "FORMAT=32-bit_rle_rgbe", "another format");
    std::getline(in, line);
    HdrPicture picture;
    if (std::sscanf(line.c_str(), "-Y %d +X %d", &picture.height, &picture.width) != 2 ||
        picture.height < 1 || picture.width < 1 || picture.height > kMaxSide ||
        picture.width > kMaxSide)
        throw Error(file.string(), "a size like \"-Y 512 +X 1024\"", "\"" + line + "\"");

    std::vector<std::array<std::uint8_t, 4>> row(static_cast<std::size_t>(picture.width));
    RowReader rows(in, file);
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
