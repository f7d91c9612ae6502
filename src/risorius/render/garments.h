// SPDX-License-Identifier: MIT
/// \file
/// The names of what the shoulders wear. The rig has the same names; a test compares them.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// "none", "crew_neck", "v_neck".
const std::vector<std::string>& garment_names();

}  // namespace risorius::render
