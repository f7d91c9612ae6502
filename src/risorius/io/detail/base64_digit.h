// SPDX-License-Identifier: MIT
/// \file
/// The letters of base64 (RFC 4648), those for URLs included.
#pragma once

namespace risorius::io::detail {

/// The six bits that a letter stands for, or -1.
inline int base64_digit(char letter) {
    if (letter >= 'A' && letter <= 'Z') return letter - 'A';
    if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
    if (letter >= '0' && letter <= '9') return letter - '0' + 52;
    if (letter == '+' || letter == '-') return 62;
    if (letter == '/' || letter == '_') return 63;
    return -1;
}

}  // namespace risorius::io::detail
