// What is inside the mouth: two arches of fourteen crowns, their gums, and the tongue at rest. Lengths in mm.
#pragma once

#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::headmodel {

enum class Arch { kUpper, kLower };

geom::PolygonMesh teeth(Arch arch, const std::string& group);
/// Of each vertex of teeth(): 0 at the neck, which the gum hides up to about 0.2, 1 at the edge of a front tooth and 0.8 on what chews.
std::vector<double> crown_heights();
geom::PolygonMesh gums(Arch arch, const std::string& group);
geom::PolygonMesh tongue(const std::string& group);

}  // namespace risorius::headmodel
