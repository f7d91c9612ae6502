// Lips that a scan has grown together, cut apart along the line between them, with the lining of a mouth behind.
//
// The cut follows the deepest line between the lips from corner to corner, through triangles where it has to; vertices of
// the mesh keep their number and, but for spikes into the mouth, their place; new ones follow after them.
#pragma once

#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"

namespace risorius::rig {

/// Whether the skin runs on from the upper to the lower lip, without a gap between them.
bool lips_are_closed(const Head& head);

struct CutLips {
    geom::PolygonMesh mesh;  ///< in units of the one given; the lining is group `lining_group`
    std::vector<int>
        upper;  ///< vertices of the upper lip along the cut, right to left, without the corners
    std::vector<int> lower;  ///< their counterparts, at the same places
    int laid_back = 0;       ///< points seen between the lips, see scan_spikes.h
    int middle = 0;          ///< which of them is nearest to stomion
    std::vector<Vec3> seam;  ///< corner to corner, head frame, m
};
inline constexpr const char* kLiningGroup = "mouth_lining";

/// `skin_groups` are indices. Throws Error naming `place` when no line between the corners can be found.
CutLips cut_lips(const geom::PolygonMesh& mesh, const Head& head,
                 const std::vector<int>& skin_groups, const std::string& place);

}  // namespace risorius::rig
