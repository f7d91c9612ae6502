// SPDX-License-Identifier: MIT
#include "risorius/core/known_names.h"

#include <algorithm>

#include "risorius/core/json_cursor.h"

namespace risorius {

std::string did_you_mean(std::string_view found, const std::vector<std::string>& names) {
    const std::string near = nearest_name(found, {names.begin(), names.end()});
    return near.empty() ? "" : " (did you mean \"" + near + "\"?)";
}

std::size_t index_of_name(const std::string& place, const std::string& found,
                          const std::vector<std::string>& names) {
    const auto at = std::find(names.begin(), names.end(), found);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    std::string expected = "one of ";
    for (std::size_t i = 0; i < names.size(); ++i)
        expected.append(i > 0 ? ", \"" : "\"").append(names[i]).append("\"");
    throw Error(place, expected + did_you_mean(found, names), "\"" + found + "\"");
}

}  // namespace risorius
