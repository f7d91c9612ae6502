// SPDX-License-Identifier: MIT
/// \file
/// Parts sheets of a surface that touch. Formats without a list of vertices (STL, and FBX as it is imported) give the corners of
/// faces, and corners at one position become one vertex. Where lips touch, more than two faces then meet at an edge.
///
/// At such an edge, two faces belong together when the same flesh lies between them: from a face, the next one on the way around
/// the edge through its inner side. Source of the rule: faces of a solid bound it in pairs, see B. G. Baumgart, Winged edge
/// polyhedron representation, Stanford 1972.
#pragma once

#include "risorius/geom/polygon_mesh.h"

namespace risorius::geom {

/// Gives each sheet its own vertices at edges with more than two faces. The first sheet keeps the vertices, and others get new
/// ones behind the last. Faces without a partner are left as they are. Returns the number of vertices added.
int part_sheets(PolygonMesh& mesh);

}  // namespace risorius::geom
