// SPDX-License-Identifier: MIT
/// \file
/// The version of the toolkit, as run records name it. It is set in one place, the project() line of CMakeLists.txt.
#pragma once

namespace risorius {

extern const char* const kVersion;

}  // namespace risorius
