// SPDX-License-Identifier: MIT
/// \file
/// Names that a person may mistype: the list of known names, and which one was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace risorius {

/// " (did you mean "muscles"?)", or an empty text when no known name is near.
std::string did_you_mean(std::string_view found, const std::vector<std::string>& names);

/// Index of a name among the known ones. Throws Error when it is none of them; the message names `place`, all known names and
/// the nearest one.
std::size_t index_of_name(const std::string& place, const std::string& found,
                          const std::vector<std::string>& names);

}  // namespace risorius
