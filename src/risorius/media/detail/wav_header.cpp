// SPDX-License-Identifier: MIT
#include "risorius/media/detail/wav_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "risorius/core/file_reader.h"

namespace risorius::media::detail {

namespace {

constexpr FileKind kWav{"a WAV file", std::numeric_limits<std::int64_t>::max()};
constexpr std::uint16_t kPcm = 1, kExtensible = 0xfffe;
// Lengths of sound that programs write when they do not know it, because they write into a pipe
constexpr std::array<std::uint64_t, 4> kUnknown{0, 0xffffffff, 0x7fffffff, 0x7ffff000};
// A file of many chunks is damaged. More are not looked at.
constexpr int kMostChunks = 1000;

using Block = std::array<unsigned char, 40>;

std::uint64_t number_at(const Block& block, std::size_t at, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | block[at + i];
    return value;
}

bool has_name(const Block& block, std::string_view name) {
    return std::equal(name.begin(), name.end(), block.begin(),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

void take_format(const Block& format, std::size_t length, WavHeader& header) {
    std::uint64_t tag = number_at(format, 0, 2);
    header.container_bits = header.valid_bits = static_cast<int>(number_at(format, 14, 2));
    if (tag == kExtensible && length >= 26) {
        const int valid = static_cast<int>(number_at(format, 18, 2));
        if (valid > 0) header.valid_bits = std::min(valid, header.container_bits);
        tag = number_at(format, 24, 2);  // the first two bytes of the sub-format
    }
    header.integers = tag == kPcm;
}

}  // namespace

std::optional<WavHeader> read_wav_header(const std::filesystem::path& file) {
    const FileReader in(file, kWav);
    Block block{};
    if (in.read_at(0, block.data(), 12) < 12) return std::nullopt;
    const bool is_rf64 = has_name(block, "RF64") || has_name(block, "BW64");
    if (!is_rf64 && !has_name(block, "RIFF")) return std::nullopt;
    WavHeader header;
    std::uint64_t at = 12, long_length = 0;  // behind "RIFF", its length and "WAVE"
    for (int chunk = 0; chunk < kMostChunks && in.read_at(at, block.data(), 8) == 8; ++chunk) {
        const std::uint64_t length = number_at(block, 4, 4);
        at += 8;
        if (has_name(block, "data")) {
            const std::uint64_t promised = is_rf64 && length == 0xffffffff ? long_length : length;
            const bool known =
                std::find(kUnknown.begin(), kUnknown.end(), promised) == kUnknown.end();
            const std::uint64_t there = in.size() - std::min(in.size(), at);
            if (known && promised > there)
                header.missing_bytes = static_cast<std::int64_t>(
                    std::min<std::uint64_t>(promised - there, kWav.max_bytes));
            break;
        }
        const bool is_format = has_name(block, "fmt "), is_long = has_name(block, "ds64");
        if (is_format || is_long) {
            const std::size_t wanted = std::min<std::uint64_t>(length, block.size());
            const std::size_t got = in.read_at(at, block.data(), wanted);
            if (is_format && got >= 16) take_format(block, got, header);
            if (is_long && got >= 16) long_length = number_at(block, 8, 8);
        }
        at += length + (length & 1);
    }
    return header;
}

}  // namespace risorius::media::detail
