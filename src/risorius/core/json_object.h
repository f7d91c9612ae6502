// SPDX-License-Identifier: MIT
/// \file
/// Makes JSON objects from lists of fields. A list of pairs alone, as the JSON library takes it, makes each length of a key a
/// type of its own: such a field takes six times as long to compile and three times the code.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "risorius/core/json_cursor.h"

namespace risorius {

/// A key with its value.
struct JsonField {
    std::string_view name;
    /// json_object() takes it over, although elements of an initializer list are constant.
    mutable Json value;
};

/// An object with these fields, in this order. Of fields with the same name, the first counts. The values are moved, so that a
/// list with a name of its own is good for one call.
Json json_object(std::initializer_list<JsonField> fields);

}  // namespace risorius
