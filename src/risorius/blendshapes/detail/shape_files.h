// SPDX-License-Identifier: MIT
/// \file
/// Writes blend shapes to files: glTF, OBJ, and the table that `risorius evaluate` reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/make_shapes.h"
#include "risorius/blendshapes/detail/morph_head.h"
#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/face/face.h"
#include "risorius/io/morph_model.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Returns a glTF model of the head, see morph_head(). The shapes are its morph targets, followed by the correctives. The glTF
/// extras hold the rig, the set, and under "correctives" the drivers of the correctives. `animation` may be null. `hair`: with the locks of the rig.
io::MorphModel morph_model(const scene::RigFiles& files, const face::Face& face,
                           const MadeShapes& shapes, const std::string& set,
                           const blendshapes::BlendShapeRig& linear,
                           const ShapeAnimation* animation, int texture_px, EyesBy eyes, bool hair);

/// Writes every vertex in every frame of the animation, in mesh units, computed with the blend shape rig. `head_turns`: with the
/// motion of head and eyes, as in a video, instead of by shapes alone. Of `formats`, "cache" is
/// folder/cache.json and folder/cache.f32, "pc2" cache.pc2 and "mdd" cache.mdd. Returns the names of the files.
std::vector<std::string> write_vertex_cache(const scene::RigFiles& files, const face::Face& face,
                                            const blendshapes::BlendShapeRig& linear,
                                            const ShapeAnimation& animation,
                                            const std::vector<std::string>& formats,
                                            bool head_turns, const std::filesystem::path& folder);

/// Writes folder/shapes.json and folder/shapes.f32 (docs/formats/measured-shapes.md) which also hold the activations that made
/// each shape. Displacements are in mesh units, and the vertices are in the order of the mesh file. Returns the names of the
/// files.
std::vector<std::string> write_shape_table(const scene::RigFiles& files, const rig::Head& head,
                                           const MadeShapes& shapes,
                                           const std::filesystem::path& folder);

/// Writes folder/obj/NAME.obj: the mesh as imported with the shape at weight 1. Vertices that do not move keep the exact numbers
/// of the import. Returns the names of the files.
std::vector<std::string> write_shape_objs(const scene::RigFiles& files, const rig::Head& head,
                                          const MadeShapes& shapes,
                                          const std::filesystem::path& folder);

}  // namespace risorius::blendshapes
