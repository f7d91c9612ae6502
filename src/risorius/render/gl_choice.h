// SPDX-License-Identifier: MIT
/// \file
/// Selects the OpenGL implementation: OSMesa, which draws in memory, or EGL without a window, which can use a graphics processor.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// The names "auto", "osmesa", "egl".
const std::vector<std::string>& gl_names();

/// Selects the implementation for all views of the process; call it before the first view. "auto" is EGL if it has a graphics
/// processor, else OSMesa. Without this call, the environment variable RISORIUS_GL decides, or else "auto". EGL on the CPU draws
/// the same bits as OSMesa; a graphics processor may not. Throws Error naming `place` for an unknown name.
void choose_gl(const std::string& name, const std::string& place);

/// The back end and its renderer, for instance "osmesa, llvmpipe (LLVM 15.0.6, 256 bits)". Empty before the first view.
std::string gl_in_use();

}  // namespace risorius::render
