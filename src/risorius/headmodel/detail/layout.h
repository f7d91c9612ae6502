// Texture coordinates of the head: charts laid flat with as little stretch as may be, and the regions of the skin by name.
//
// The skin of face, scalp, neck and shoulders is one chart, symmetric about u = 1/2 and cut at the back of the head, from the crown
// down; the ears are cut off where they leave the head, the nostrils at their rims and open at one side, the lining of the mouth where the lips meet and in
// its own middle. All of these share one square at one scale. The other parts bring their layout (part_layout.h).
#pragma once

#include "risorius/headmodel/detail/half_mesh.h"

namespace risorius::headmodel {

/// Gives skin and mouth of `mesh`, which begins with the mirrored `half`, their corner_texcoord. `crown_z` in mm: midline vertices behind it are the seam.
/// The lips are laid out shut: each vertex of `lower` in one place with that of `upper`.
void lay_out(const HalfMesh& half, double crown_z, const std::vector<int>& upper,
             const std::vector<int>& lower, geom::PolygonMesh& mesh);

/// As rigid as possible (Liu et al. 2008): a disc of quads laid flat, mm, a place for each vertex of the faces; vertices of `straight`
/// keep u = 0. Place of those that no face has: zero. Throws Error when the faces are no disc.
std::vector<Vec2> flatten(const std::vector<Vec3>& points,
                          const std::vector<std::array<int, 4>>& faces,
                          const std::vector<bool>& straight);

}  // namespace risorius::headmodel
