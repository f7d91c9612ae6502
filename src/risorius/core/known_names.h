// SPDX-License-Identifier: MIT
/// \file
/// Finds the name that the user probably meant in a list of known names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace risorius {

/// Returns a text such as " (did you mean "muscles"?)", or an empty one when no known name is similar.
std::string did_you_mean(std::string_view found, const std::vector<std::string>& names);

/// Returns the index of the name `found` in `names`. Throws Error when it is not there; the message contains `place`, all known
/// names and the most similar one.
std::size_t index_of_name(const std::string& place, const std::string& found,
                          const std::vector<std::string>& names);

}  // namespace risorius
