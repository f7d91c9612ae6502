// SPDX-License-Identifier: MIT
/// \file
/// Mends what scans have: double faces, faces without area, faces that are flipped, more than two faces at an edge, and loose
/// bits beside the surface.
#pragma once

#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::geom {

struct RepairOptions {
    std::vector<int> groups{};  ///< groups whose faces are mended; empty: all
    double metres_per_unit = 1.0;
    double smallest_face_area_m2 = 1e-13;
    /// A piece with fewer faces than this fraction of the largest one is a loose bit.
    double loose_bit = 0.01;
};

/// Mends a mesh. Vertices stay, also those that no face uses any more. Returns what was done, in sentences; empty when there was
/// nothing to do. In this order:
///   1. A vertex that follows itself in a face is listed once. Faces with less than three corners, with a vertex twice, or
///      without area are taken out.
///   2. Of several faces with the same vertices, the first one stays.
///   3. At an edge with more than two faces, those of the largest pieces stay.
///   4. Loose bits are taken out.
///   5. Faces of a piece are turned such that neighbours face the same way, and most of the piece outwards.
std::vector<std::string> repair_mesh(PolygonMesh& mesh, const RepairOptions& options = {});

}  // namespace risorius::geom
