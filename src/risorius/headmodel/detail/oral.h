// SPDX-License-Identifier: MIT
/// \file
/// The inside of the mouth: two arches of fourteen tooth crowns, their gums, and the tongue at rest. Lengths in mm.
#pragma once

#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::headmodel {

enum class Arch { kUpper, kLower };

geom::PolygonMesh teeth(Arch arch, const std::string& group);
/// Returns the relative height on the crown for each vertex of teeth(): 0 at the neck, 1 at the edge of a front tooth, 0.8 on a
/// chewing surface. The gum hides the crown up to about 0.2.
std::vector<double> crown_heights();
geom::PolygonMesh gums(Arch arch, const std::string& group);
geom::PolygonMesh tongue(const std::string& group);

}  // namespace risorius::headmodel
