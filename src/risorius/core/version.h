// SPDX-License-Identifier: MIT
/// \file
/// The version of the toolkit, as it is written in run records. It is set in the project() line of CMakeLists.txt.
#pragma once

namespace risorius {

extern const char* const kVersion;

}  // namespace risorius
