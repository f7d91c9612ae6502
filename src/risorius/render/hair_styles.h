// SPDX-License-Identifier: MIT
/// \file
/// The names of the styles of hair, and of the forms of hairline and beard. The rig has the same names; a test compares them.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// "shaven", "crop", "short_parted", "curly_short", "afro", "bob", "long_tied", "bald_fringe".
const std::vector<std::string>& hair_style_names();

/// "even", "round", "widows_peak", "m", "high", "receding".
const std::vector<std::string>& hairline_form_names();

/// "stubble", "full", "moustache", "goatee", "jawline".
const std::vector<std::string>& beard_form_names();

}  // namespace risorius::render
