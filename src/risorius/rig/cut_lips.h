// SPDX-License-Identifier: MIT
/// \file
/// Cuts apart lips that have grown together in a scan, along the line between them, and adds a lining of the mouth behind the cut.
///
/// The cut follows the deepest line between the lips from corner to corner and passes through triangles where it has to. Vertices of the
/// mesh keep their number. They keep their place too, except for spikes into the mouth. New vertices follow after the old ones.
#pragma once

#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"

namespace risorius::rig {

/// Whether the skin continues from the upper to the lower lip without a gap.
bool lips_are_closed(const Head& head);

struct CutLips {
    geom::PolygonMesh mesh;  ///< in units of the one given; the lining is group `lining_group`
    std::vector<int>
        upper;  ///< vertices of the upper lip along the cut, right to left, without the corners
    std::vector<int> lower;  ///< their counterparts, at the same places
    int laid_back =
        0;  ///< number of points that the scanner saw between the lips and that were moved back, see scan_spikes.h
    int middle = 0;          ///< index, in `upper`, of the vertex nearest to the landmark stomion
    std::vector<Vec3> seam;  ///< corner to corner, head frame, m
};
inline constexpr const char* kLiningGroup = "mouth_lining";

/// `skin_groups` are group indices. Throws Error that names `place` when no line between the corners is found.
CutLips cut_lips(const geom::PolygonMesh& mesh, const Head& head,
                 const std::vector<int>& skin_groups, const std::string& place);

}  // namespace risorius::rig
