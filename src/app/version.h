// The version of the toolkit, as run records name it.
#pragma once

namespace risorius::app {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace risorius::app
