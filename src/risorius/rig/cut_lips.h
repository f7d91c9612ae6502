// SPDX-License-Identifier: MIT
/// \file
/// Separates the lips of a scan that has no gap between them: cuts along the line between the lips, and adds a mouth lining
/// behind the cut.
///
/// The cut follows the deepest line between the lips from corner to corner and splits triangles where necessary. The vertices of
/// the mesh keep their indices. They also keep their positions, except those in spikes into the mouth (scan_spikes.h). New
/// vertices are appended.
#pragma once

#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"

namespace risorius::rig {

/// Returns whether the skin continues from the upper to the lower lip without a gap.
bool lips_are_closed(const Head& head);

/// The result of the cut.
struct CutLips {
    /// In the units of the given mesh; the lining is the group kLiningGroup
    geom::PolygonMesh mesh;
    /// Vertices of the upper lip along the cut, from right to left, without the corners
    std::vector<int> upper;
    std::vector<int> lower;  ///< the corresponding vertices of the lower lip, at the same positions
    /// Number of scanned points deep between the lips that were moved back, see scan_spikes.h
    int laid_back = 0;
    int middle = 0;          ///< index in `upper` of the vertex nearest to the landmark stomion
    std::vector<Vec3> seam;  ///< the cut from corner to corner, head frame, m
};
inline constexpr const char* kLiningGroup = "mouth_lining";

/// Cuts the lips of a mesh. `skin_groups`: indices of the mesh groups of the skin. Throws Error when no line between the corners
/// of the mouth is found; the message begins with `place`.
CutLips cut_lips(const geom::PolygonMesh& mesh, const Head& head,
                 const std::vector<int>& skin_groups, const std::string& place);

}  // namespace risorius::rig
