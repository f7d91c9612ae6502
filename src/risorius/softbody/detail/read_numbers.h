// SPDX-License-Identifier: MIT
/// \file
/// Functions that read positive and non-negative numbers, and the maximum number of nodes. They throw Error for other values.
#pragma once

#include "risorius/core/json_cursor.h"

namespace risorius::softbody::detail {

inline constexpr int kMaxNodesPerAxis = 1000;

inline double positive(const JsonCursor& json) {
    if (!json.is_number() || !(json.number() > 0)) json.fail("a number in (0, inf)");
    return json.number();
}

inline double not_negative(const JsonCursor& json) { return json.number({0, kInfinity}); }

inline double not_negative(const JsonCursor& json, std::string_view key, double otherwise) {
    const auto found = json.find(key);
    return found ? not_negative(*found) : otherwise;
}

}  // namespace risorius::softbody::detail
