// SPDX-License-Identifier: MIT
/// \file
/// Writes a mesh with blend shapes as text of Universal Scene Description (.usda), with the blend shapes and the animation of
/// UsdSkel.
///
/// There is a SkelRoot "Head" with a mesh for each node, in metres with y up. Each mesh has its shapes below it, which hold the
/// vertices that they move, and an animation has the weights of all shapes, one time code a frame. Materials, pictures and joints
/// are left out. Names of prims have letters, digits and underscores only.
///
/// Source: Pixar, OpenUSD 24, the schemas UsdGeomMesh, UsdSkelBlendShape, UsdSkelAnimation and UsdSkelBindingAPI. Debian has no
/// library of USD, so that the text is checked by a parser in the tests alone.
#pragma once

#include <string>

#include "risorius/io/morph_model.h"

namespace risorius::io {

/// Returns the text. It depends only on the model.
std::string usda_text(const MorphModel& model);

}  // namespace risorius::io
