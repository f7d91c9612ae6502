// SPDX-License-Identifier: MIT
/// \file
/// Sources of the shader programs that paint the paint map (skin_paint.h): the skin, and strokes over it.
#pragma once

#include <string>

namespace risorius::render {

std::string paint_vertex_shader();
std::string paint_fragment_shader();
std::string own_skin_vertex_shader();  ///< for the mesh's own textures, over the paint
std::string own_skin_shader();
std::string stroke_vertex_shader();
std::string stroke_fragment_shader();

}  // namespace risorius::render
