// SPDX-License-Identifier: MIT
#include "risorius/core/json_object.h"

#include <utility>

namespace risorius {

Json json_object(std::initializer_list<JsonField> fields) {
    Json object = Json::object();
    for (const JsonField& field : fields)
        object.emplace(std::string(field.name), std::move(field.value));
    return object;
}

}  // namespace risorius
