// SPDX-License-Identifier: MIT
/// \file
/// The names of a table.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// Returns the member `name` of every row, in order.
template <typename Table>
std::vector<std::string> names_of(const Table& table) {
    std::vector<std::string> names;
    for (const auto& row : table) names.emplace_back(row.name);
    return names;
}

}  // namespace risorius::render
