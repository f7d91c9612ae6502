// SPDX-License-Identifier: MIT
/// \file
/// Chooses the OpenGL implementation: OSMesa, which draws in memory, or EGL without a window, which can use a graphics processor.
#pragma once

#include <string>
#include <vector>

namespace risorius::render {

/// "auto", "osmesa", "egl"
const std::vector<std::string>& gl_names();

/// For all views of the process; before the first. "auto" is EGL where it has a graphics processor, or else OSMesa. Not called:
/// as the environment's RISORIUS_GL says, or "auto". EGL on the processor draws the same as OSMesa, to the bit; a graphics
/// processor need not. Throws Error naming `place` for an unknown name.
void choose_gl(const std::string& name, const std::string& place);

/// The back end and what it draws with: "osmesa, llvmpipe (LLVM 15.0.6, 256 bits)". Empty before the first view.
std::string gl_in_use();

}  // namespace risorius::render
