// SPDX-License-Identifier: MIT
/// \file
/// The parts of a mesh that no expression may bend: teeth, eyes, and loose pieces inside the mouth.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"

namespace risorius::blendshapes {

/// Returns the vertices of each rigid part: every connected piece of the groups that are teeth or eyes by their role or their name,
/// and every piece of the skin's groups that lies in the mouth and is not connected to the rest. Teeth of a mesh without roles for
/// them are such pieces.
std::vector<std::vector<int>> rigid_parts(const rig::Head& head, const geom::PolygonMesh& mesh);

/// Returns the largest distance, m, of a vertex of a part from where the nearest rigid motion of that part puts it. `rest` and
/// `moved`: V x 3, m. 0 if there are no parts.
double bent_by_m(const std::vector<std::vector<int>>& parts, const Points& rest,
                 const Points& moved);

}  // namespace risorius::blendshapes
