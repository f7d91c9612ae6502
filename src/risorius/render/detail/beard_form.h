// SPDX-License-Identifier: MIT
/// \file
/// Forms of a beard: which places of the face it grows on, and whether it is cut at the skin.
#pragma once

#include <array>
#include <string>

namespace risorius::render {

struct BeardForm {
    const char* name;  ///< one of beard_form_names()
    std::array<bool, 9>
        spots;  ///< those of the skin's plan: chin, under it, moustache (2), jaw (4), beside the chin
    double spread;  ///< of the spots, against stubble
    bool trimmed;   ///< its hairs are some millimetres long
};

/// Throws Error on an unknown name.
const BeardForm& beard_form(const std::string& name);

}  // namespace risorius::render
