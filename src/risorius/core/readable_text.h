// SPDX-License-Identifier: MIT
/// \file
/// Text from outside as it may stand in a message, on a terminal and in JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace risorius {

/// Returns valid UTF-8 without control characters. A control character becomes "\x1b", and each byte that does not belong to
/// a character of UTF-8 becomes "\xff" (backslash, x, two digits). Line breaks become "\n". Other text stays as it is.
std::string readable_text(std::string_view text);

/// The beginning of readable_text(), cut between two characters. A text that was cut ends with "...". The result without the
/// dots has at most `max_bytes` bytes.
std::string shortened_text(std::string_view text, std::size_t max_bytes);

/// The number of bytes of the character of UTF-8 at the start of `text`, 1 to 4; 0 when the bytes are no character.
std::size_t character_size(std::string_view text);

}  // namespace risorius
