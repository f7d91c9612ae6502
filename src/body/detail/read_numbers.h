// Numbers of a description that have to lie in a half-open range.
#pragma once

#include <limits>

#include "core/json_cursor.h"

namespace risorius::body::detail {

inline double positive(const JsonCursor& json) {
    if (!json.is_number() || !(json.number() > 0)) json.fail("a number in (0, inf)");
    return json.number();
}

inline double not_negative(const JsonCursor& json) {
    return json.number({0, std::numeric_limits<double>::infinity()});
}

inline double not_negative(const JsonCursor& json, std::string_view key, double otherwise) {
    const auto found = json.find(key);
    return found ? not_negative(*found) : otherwise;
}

}  // namespace risorius::body::detail
