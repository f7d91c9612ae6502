// SPDX-License-Identifier: MIT
/// \file
/// Selects the OpenGL implementation: OSMesa, which draws in memory, or EGL without a window, which can use a graphics processor.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// The names "auto", "osmesa", "egl".
const std::vector<std::string>& gl_names();

/// Selects the implementation for all views of the process. Call it before the first view is made. "auto" is EGL if EGL finds a
/// graphics processor, else OSMesa. Without this call, the environment variable RISORIUS_GL gives the name; if it is not set, the
/// name is "auto". EGL on the CPU draws the same bits as OSMesa; a graphics processor may draw slightly different ones. Throws
/// Error for an unknown name; the message begins with `place`, which says where the name was given.
void choose_gl(const std::string& name, const std::string& place);

/// Returns the selected implementation and its renderer, for instance "osmesa, llvmpipe (LLVM 15.0.6, 256 bits)". Empty before
/// the first view.
std::string gl_in_use();

}  // namespace risorius::render
