// SPDX-License-Identifier: MIT
/// \file
/// A landmark that a table names.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::rig {

/// Returns the landmark's id. Throws Error when it is not in `known`; the message has the most similar id.
std::string known_landmark(const JsonCursor& named, const std::vector<std::string>& known);

}  // namespace risorius::rig
