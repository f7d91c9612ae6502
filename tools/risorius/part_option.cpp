// SPDX-License-Identifier: MIT
#include "tools/risorius/part_option.h"

#include <algorithm>

#include "risorius/core/error.h"

namespace risorius::cli {

namespace {

// Reads a part such as "skin=face,neck".
void add_part(const std::string& text, std::map<std::string, std::vector<std::string>>& parts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size())
        throw Error("--part", "ROLE=GROUP,GROUP", "\"" + text + "\"");
    std::vector<std::string>& groups = parts[text.substr(0, equals)];
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        groups.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

}  // namespace

std::map<std::string, std::vector<std::string>> parts_of(const std::vector<std::string>& texts) {
    std::map<std::string, std::vector<std::string>> out;
    for (const std::string& text : texts) add_part(text, out);
    return out;
}

}  // namespace risorius::cli
