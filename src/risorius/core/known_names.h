// SPDX-License-Identifier: MIT
/// \file
/// Names that a person may get wrong: all there are, and which one was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace risorius {

/// " (did you mean "muscles"?)", or nothing when no known name is near.
std::string did_you_mean(std::string_view found, const std::vector<std::string>& names);

/// Where a name stands among the known ones. Throws Error naming `place`, all of them and the nearest when it is none.
std::size_t index_of_name(const std::string& place, const std::string& found,
                          const std::vector<std::string>& names);

}  // namespace risorius
