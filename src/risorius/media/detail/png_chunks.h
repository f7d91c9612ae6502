// SPDX-License-Identifier: MIT
/// \file
/// The chunks of a PNG file in memory, as they stand one after the other behind its signature. Source: PNG, third edition
/// (W3C 2025), section 5.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace risorius::media::detail {

inline constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P',  'N',  'G',
                                                           '\r', '\n', 0x1a, '\n'};

inline bool is_png(const std::vector<std::uint8_t>& bytes) {
    return bytes.size() >= kPngSignature.size() &&
           std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin());
}

struct PngChunk {
    std::string_view type;  ///< four letters, in the bytes of the file
    std::size_t size =
        0;  ///< bytes with length, type and checksum; may lead beyond the end of the file
};

/// The chunk that begins at byte `at`; nothing when the file is too short for one.
inline std::optional<PngChunk> png_chunk(const std::vector<std::uint8_t>& bytes, std::size_t at) {
    constexpr std::size_t kAround = 12;  // length, type and checksum
    if (at > bytes.size() || bytes.size() - at < kAround) return std::nullopt;
    std::size_t data = 0;
    for (std::size_t i = 0; i < 4; ++i) data = data << 8 | bytes[at + i];
    return PngChunk{{reinterpret_cast<const char*>(bytes.data()) + at + 4, 4}, kAround + data};
}

}  // namespace risorius::media::detail
