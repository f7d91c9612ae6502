// SPDX-License-Identifier: MIT
/// \file
/// Texture coordinates of the head: charts flattened with little distortion, and the regions of the skin by name.
///
/// The skin of face, scalp, neck and shoulders is one chart, symmetric about u = 1/2 and cut at the back of the head, from the crown down.
/// Ears are cut off where they meet the head, nostrils at their rims and open at one side, the lining of the mouth where the lips meet and
/// along its own middle. All of these share one square at one scale. The other parts bring their layout (part_layout.h).
#pragma once

#include "risorius/headmodel/detail/half_mesh.h"

namespace risorius::headmodel {

/// Sets corner_texcoord of skin and mouth of `mesh`, which begins with the mirrored `half`. `crown_z` in mm: midline vertices behind it are
/// the seam. The lips are laid out closed: each vertex of `lower` at the place of that of `upper`.
void lay_out(const HalfMesh& half, double crown_z, const std::vector<int>& upper,
             const std::vector<int>& lower, geom::PolygonMesh& mesh);

/// Flattens a disc of quads as rigidly as possible (Liu et al. 2008). Returns a position in the plane, mm, for each vertex.
/// Vertices of `straight` have u = 0. Vertices without a face are at 0. Throws Error when the faces do not form a disc.
std::vector<Vec2> flatten(const std::vector<Vec3>& points,
                          const std::vector<std::array<int, 4>>& faces,
                          const std::vector<bool>& straight);

}  // namespace risorius::headmodel
