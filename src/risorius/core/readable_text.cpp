// SPDX-License-Identifier: MIT
#include "risorius/core/readable_text.h"

#include <algorithm>
#include <cstdint>

namespace risorius {

namespace {

std::uint8_t byte_of(char c) { return static_cast<std::uint8_t>(c); }

/// How many bytes at the start are ASCII without control characters, so that they stay as they are.
std::size_t plain_size(std::string_view text) {
    const auto end = std::find_if(text.begin(), text.end(),
                                  [](char c) { return byte_of(c) < 0x20 || byte_of(c) >= 0x7F; });
    return static_cast<std::size_t>(end - text.begin());
}

/// The character at the start of `text` as readable_text() writes it. Reduces `text` by it.
std::string take_readable(std::string_view& text) {
    const std::size_t size = character_size(text);
    const std::string_view taken = text.substr(0, size == 0 ? 1 : size);
    text.remove_prefix(taken.size());
    const std::uint8_t first = byte_of(taken.front());
    if (first == '\n') return "\\n";
    // C1 controls, U+0080 to U+009F, are two bytes long. Some terminals obey them.
    const bool is_c1 = size == 2 && first == 0xC2 && byte_of(taken[1]) < 0xA0;
    if (size > 0 && first >= 0x20 && first != 0x7F && !is_c1) return std::string(taken);
    constexpr const char* kDigits = "0123456789abcdef";
    std::string out;
    for (const char c : taken) {
        out += "\\x";
        out += kDigits[byte_of(c) >> 4];
        out += kDigits[byte_of(c) & 15];
    }
    return out;
}

}  // namespace

std::size_t character_size(std::string_view text) {
    if (text.empty()) return 0;
    const std::uint8_t first = byte_of(text[0]);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
    if (size == 0 || text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte_of(text[i]) & 0xC0) != 0x80) return 0;
    // Too long a form of a character, a surrogate, or beyond U+10FFFF
    const std::uint8_t second = byte_of(text[1]);
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
        return 0;
    return size;
}

std::string readable_text(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t plain = plain_size(text);
        out += text.substr(0, plain);
        text.remove_prefix(plain);
        if (!text.empty()) out += take_readable(text);
    }
    return out;
}

std::string shortened_text(std::string_view text, std::size_t max_bytes) {
    const std::size_t plain = std::min(plain_size(text), max_bytes);
    std::string out(text.substr(0, plain));
    text.remove_prefix(plain);
    while (!text.empty()) {
        const std::string next = take_readable(text);
        if (out.size() + next.size() > max_bytes) return out + "...";
        out += next;
    }
    return out;
}

}  // namespace risorius
