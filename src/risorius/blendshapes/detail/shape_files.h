// SPDX-License-Identifier: MIT
/// \file
/// Writes blend shapes to files: glTF, OBJ, and the plain table that `evaluate` reads too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/make_shapes.h"
#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/io/morph_model.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Parts by role, in the colours of the rig's appearance; shapes as morph targets. The extras name the rig and the set. Correctives follow
/// after the shapes; their drivers are listed under "correctives" of the extras. `animation` may be null.
io::MorphModel morph_model(const scene::RigFiles& files, const rig::Head& head,
                           const MadeShapes& shapes, const std::string& set,
                           const blendshapes::BlendShapeRig& linear,
                           const ShapeAnimation* animation);

/// folder/cache.json and cache.f32: every vertex in every frame of the animation, mesh units, from the blend shape rig.
std::vector<std::string> write_vertex_cache(const scene::RigFiles& files, const rig::Head& head,
                                            const blendshapes::BlendShapeRig& linear,
                                            const ShapeAnimation& animation,
                                            const std::filesystem::path& folder);

/// folder/shapes.json and shapes.f32, see docs/formats/measured-shapes.md, with the activations that made each shape: mesh units,
/// vertices in the mesh file's order. Returns the names of the files.
std::vector<std::string> write_shape_table(const scene::RigFiles& files, const rig::Head& head,
                                           const MadeShapes& shapes,
                                           const std::filesystem::path& folder);

/// folder/obj/NAME.obj: the mesh as imported with the shape at weight 1; vertices that do not move have the very numbers
/// of the import. Returns the names of the files.
std::vector<std::string> write_shape_objs(const scene::RigFiles& files, const rig::Head& head,
                                          const MadeShapes& shapes,
                                          const std::filesystem::path& folder);

}  // namespace risorius::blendshapes
